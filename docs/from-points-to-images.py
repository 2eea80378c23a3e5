"""The course's story in one notebook: points, their spectrum, the variance that it predicts, and the image.

`marimo edit docs/from-points-to-images.py` opens it; `python docs/from-points-to-images.py` runs it from top to bottom.
"""

import marimo

app = marimo.App(width="medium")


@app.cell
def _():
    import marimo as mo
    import numpy as np
    import samplekit_spectrum

    import samplekit
    from samplekit.plots import PointsDisplay, curve_style, make_axes, style

    return PointsDisplay, curve_style, make_axes, mo, np, samplekit, samplekit_spectrum, style


@app.cell
def _(mo):
    mo.md("""
    # From points to images

    A pixel is an integral, and a renderer estimates it with points. Which points are good? Here are four samplers; change the list, and all
    below follows.
    """)
    samplers = ["random", "jittered", "poisson-disk", "sobol+owen"]
    return (samplers,)


@app.cell
def _(PointsDisplay, make_axes, mo, np, samplekit, samplers):
    _places = [(0, column) for column in range(len(samplers))]
    _figure, _axes = make_axes(_places, 2.0, 2.0, left=0.4, above=0.55, below=0.1, gap=(0.4, 0.0))
    for _ax, _name in zip(_axes, samplers, strict=True):
        PointsDisplay(samplekit.points(_name, count=256)[0]).plot(_ax)
        _ax.set_title(_name, fontsize=9)

    assert all(np.all(samplekit.points(name, count=256) < 1.0) for name in samplers)
    mo.vstack([mo.md("## 256 points of each"), _figure])
    return


@app.cell
def _(curve_style, make_axes, mo, samplekit_spectrum, samplers, style):
    spectra = {
        name: samplekit_spectrum.power(name, 256, realizations=200, max_frequency=48, seed=1) for name in samplers
    }
    _figure, (_ax,) = make_axes([(0, 0)], 5.0, 2.2, right=1.4)
    for _number, (_name, _spectrum) in enumerate(spectra.items()):
        _radial = _spectrum.radial
        _ax.plot(_radial.frequency, 256 * _radial.power, label=_name, **curve_style(_number, marked=False))
    _ax.set(xlabel="frequency", ylabel="$N$ times the power, mean over rings", xlim=(0, 48), ylim=(0, 2.2))
    with style():
        _ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
    mo.vstack(
        [
            mo.md(
                "## Their expected power spectra\n\nWhat is dark in the middle is good: images are strongest at low frequencies."
            ),
            _figure,
        ]
    )
    return (spectra,)


@app.cell
def _(mo, samplekit_spectrum, samplers):
    comparisons = {
        name: samplekit_spectrum.predict(name, "disk", 64, trials=4000, realizations=400, native=False, seed=2)
        for name in samplers
    }
    rows = [
        {
            "sampler": name,
            "predicted": found.predicted.variance,
            "measured": found.measured.variance,
            "ratio": found.ratio,
        }
        for name, found in comparisons.items()
    ]
    assert all(0.85 < row["ratio"] < 1.15 for row in rows), rows
    mo.vstack(
        [
            mo.md(
                "## The variance that they predict\n\nThe sum over all whole frequencies of the product of both powers, the disk's and the "
                "sampler's, is the variance of the randomly shifted sampler. Beside it, what 4000 estimates show."
            ),
            mo.ui.table(rows, selection=None),
        ]
    )
    return


@app.cell
def _(mo, samplekit, samplers):
    study = samplekit.compare(samplers, "disk", [16, 64, 256, 1024], trials=400, size=(1, 1), times=False)
    mo.vstack([mo.md("## So the error falls"), study.plot().figure_])
    return


@app.cell
def _(mo, samplekit, samplers):
    def beside(name):
        result = samplekit.render("zoneplate:k=300", name, spp=4, size=(160, 160))
        return mo.vstack([mo.md(f"**{name}**: mse {result.metrics['mse']:.4f}"), result.plot(scale=0.5).figure_])

    mo.vstack([mo.md("## And the image gets better"), *[beside(name) for name in samplers]])
    return


if __name__ == "__main__":
    app.run()
