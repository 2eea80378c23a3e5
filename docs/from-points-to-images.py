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
    from samplekit._drawing.axis import Axis, spanning
    from samplekit._drawing.chart import Chart, legend
    from samplekit._drawing.drawing import Disks, Drawing
    from samplekit._drawing.series import style
    from samplekit._drawing.vector import svg_text
    from samplekit.files._images.falsecolor import error_picture
    from samplekit.files._images.png import encode_srgb

    return (
        Axis,
        Chart,
        Disks,
        Drawing,
        encode_srgb,
        error_picture,
        legend,
        mo,
        np,
        samplekit,
        samplekit_spectrum,
        spanning,
        style,
        svg_text,
    )


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
def _(Disks, Drawing, mo, np, samplekit, samplers, svg_text):
    def dots(name):
        drawing = Drawing(220, 220, name)
        drawing.frame(0, 0, 219, 219)
        drawing.add(Disks(220 * samplekit.points(name, count=256)[0], 2.0, "#1f2937"))
        return mo.vstack([mo.md(f"**{name}**"), mo.Html(svg_text(drawing, {}).partition("\n")[2])])

    assert all(np.all(samplekit.points(name, count=256) < 1.0) for name in samplers)
    mo.vstack([mo.md("## 256 points of each"), mo.hstack([dots(name) for name in samplers])])
    return


@app.cell
def _(Axis, Chart, Drawing, legend, mo, samplekit_spectrum, samplers, style, svg_text):
    spectra = {
        name: samplekit_spectrum.power(name, 256, realizations=200, max_frequency=48, seed=1) for name in samplers
    }
    _drawing = Drawing(720, 330, "radial means")
    _chart = Chart(
        _drawing, 60, 30, 700, 280, Axis(0, 48, "frequency"), Axis(0, 2.2, "N times the power, mean over rings")
    )
    _chart.grid()
    for _number, (_name, _spectrum) in enumerate(spectra.items()):
        _chart.curve(_spectrum.radial.frequency, 256 * _spectrum.radial.power, style(_number), marked=False)
    legend(_drawing, 80, 50, [(_name, style(_number)) for _number, _name in enumerate(spectra)])
    mo.vstack(
        [
            mo.md(
                "## Their expected power spectra\n\nWhat is dark in the middle is good: images are strongest at low frequencies."
            ),
            mo.Html(svg_text(_drawing, {}).partition("\n")[2]),
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
def _(Chart, Drawing, legend, mo, np, samplekit, samplers, spanning, style, svg_text):
    counts = [16, 64, 256, 1024]
    exact = np.pi * 0.3**2
    errors = {
        name: [
            float(np.mean((samplekit.estimate("disk", name, count=n, realizations=400) - exact) ** 2)) for n in counts
        ]
        for name in samplers
    }
    _drawing = Drawing(720, 380, "convergence")
    _chart = Chart(
        _drawing,
        70,
        30,
        700,
        320,
        spanning(counts, "samples", 2),
        spanning(list(errors.values()), "mean square error", 10),
    )
    _chart.grid()
    for _number, (_name, _errors) in enumerate(errors.items()):
        _chart.curve(counts, _errors, style(_number))
    _chart.guide(-1.0, 16, errors["random"][0] if "random" in errors else 1e-2, "1/N")
    legend(_drawing, 90, 230, [(_name, style(_number)) for _number, _name in enumerate(errors)])
    mo.vstack([mo.md("## So the error falls"), mo.Html(svg_text(_drawing, {}).partition("\n")[2])])
    return


@app.cell
def _(encode_srgb, error_picture, mo, samplekit, samplers):
    def beside(name):
        result = samplekit.render("zoneplate:k=300", name, spp=4, size=(160, 160))
        images = [mo.image(encode_srgb(result.image)), mo.image(error_picture(result.error, scale=0.5)[0])]
        return mo.vstack([mo.md(f"**{name}**: mse {result.metrics['mse']:.4f}"), *images])

    mo.vstack([mo.md("## And the image gets better"), mo.hstack([beside(name) for name in samplers])])
    return


if __name__ == "__main__":
    app.run()
