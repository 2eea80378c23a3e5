"""``samplekit predict``: the variance that spectra predict, beside the measured one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from samplekit.commands import JsonOption, SeedOption, complete_sampler, complete_scene

if TYPE_CHECKING:
    from samplekit_spectrum.measurement import Measurement
    from samplekit_spectrum.prediction import Comparison

SCHEMA = "samplekit.prediction/1"


def predict(
    sampler: Annotated[
        str,
        typer.Option(
            "--sampler",
            "-s",
            metavar="NAME[:OPTION=VALUE,...][+RANDOMIZER]",
            help="The sampler, such as jittered or sobol+owen.",
            autocompletion=complete_sampler,
        ),
    ],
    scene: Annotated[
        str,
        typer.Option(
            "--scene", metavar="NAME[:OPTION=VALUE,...]", help="What is integrated.", autocompletion=complete_scene
        ),
    ],
    count: Annotated[
        str, typer.Option("--count", "-n", metavar="LIST", help="Samples: 1,4,16 or 2^0..2^12 or 4^1..4^5.")
    ],
    trials: Annotated[
        str, typer.Option("--trials", metavar="T", help="Estimates that are measured; by default 40000 or more.")
    ] = "",
    realizations: Annotated[
        str,
        typer.Option("--realizations", "-r", metavar="R", help="Sets in the expected spectrum; by default enough."),
    ] = "",
    max_frequency: Annotated[
        str, typer.Option("--max-frequency", "-f", metavar="F", help="Largest frequency; by default about 16 sqrt N.")
    ] = "",
    seed: SeedOption = "0",
    threads: Annotated[
        str, typer.Option("--threads", "-t", metavar="T", help="Threads; by default one for each processor.")
    ] = "",
    json: JsonOption = False,
) -> int:
    """Predict the variance of estimates from the spectra of sampler and scene, and measure it.

    The prediction is exact only for a sampler that a random shift follows, so it is made for that. The variance of the
    sampler without the shift (native) stands beside it.

    Example: samplekit predict --sampler jittered --scene disk --count 4^2..4^5
    """
    from samplekit.commands import announce_compilation

    announce_compilation()
    import samplekit
    from samplekit import check_threads
    from samplekit.commands import Progress, parse_count, parse_counts, parse_seed
    from samplekit_spectrum.homogenized import is_homogeneous
    from samplekit_spectrum.integrands import integrand_of
    from samplekit_spectrum.prediction import check_settings
    from samplekit_spectrum.prediction import predict as predict_one

    counts = parse_counts(count, "count")
    chosen, integrated = samplekit.sampler(sampler).fresh(), samplekit.scene(scene)
    for number in counts:
        # Before anything is computed: the last of a list would otherwise fail after hours.
        chosen.check(number, integrated.dims)
    settings: dict[str, Any] = {
        "trials": parse_count(trials, "trials") if trials else None,
        "realizations": parse_count(realizations, "realizations") if realizations else None,
        "max_frequency": parse_count(max_frequency, "max-frequency") if max_frequency else None,
        "seed": parse_seed(seed),
    }
    check_settings(**settings)
    settings["threads"] = check_threads(parse_count(threads, "threads")) if threads else None
    integrand = integrand_of(integrated)
    with_native = not is_homogeneous(chosen)
    if not json:
        for line in _heading(chosen.text, integrated.text, settings, integrand, with_native):
            typer.echo(line)
    rows = []
    for number in counts:
        bars: dict[str, Progress] = {}

        def show(what: str, done: int, total: int, bars: dict[str, Progress] = bars) -> None:
            if what not in bars:
                for bar in bars.values():
                    bar.__exit__()
                bars[what] = Progress(what)
            bars[what](done, total)

        try:
            row = predict_one(chosen, integrated, number, progress=show, **settings)
        finally:
            for bar in bars.values():
                bar.__exit__()
        rows.append(row)
        if not json:
            typer.echo(_line(row, with_native))
    if json:
        from json import dumps

        report = {
            "schema": SCHEMA,
            "sampler": chosen.text,
            "scene": integrated.text,
            "homogenized": True,
            "confidence": 0.99,
            "seed": settings["seed"],
            "integrand": {
                "mean": integrand.mean,
                "variance": integrand.variance,
                "approximate": integrand.approximate,
                "aliasing": integrand.aliasing,
            },
            "rows": [_json(row) for row in rows],
        }
        typer.echo(dumps(report, allow_nan=False))
    return 0


def _heading(sampler: str, scene: str, settings: dict[str, Any], integrand: Any, with_native: bool) -> list[str]:
    lines = [f"{scene}, {sampler} with a random shift, seed {settings['seed']}"]
    if integrand.approximate:
        lines.append(f"  the scene's spectrum is approximate: its sum is off by about {integrand.aliasing:.2g}")
    head = f"  {'count':>8}{'predicted':>12}{'+-':>9}{'tail':>9}{'at most':>9}{'measured':>12}{'ratio':>8}{'99 %':>18}"
    lines.append(head + (f"{'native':>12}" if with_native else "") + "  verdict")
    return lines


def _line(row: Comparison, with_native: bool) -> str:
    predicted, measured = row.predicted, row.measured
    # Shares and ratios of two zeros say nothing.
    exact = row.verdict == "exact"
    parts = (predicted.standard_error, predicted.tail, predicted.tail_bound)
    shares = "".join(f"{'-' if exact else f'{part / predicted.variance:.2%}':>9}" for part in parts)
    ratio, interval = ("-", "-") if exact else (f"{row.ratio:.4f}", f"{row.ratio_low:.4f} to {row.ratio_high:.4f}")
    line = f"  {row.count:>8}{predicted.variance:>12.4e}{shares}{measured.variance:>12.4e}{ratio:>8}{interval:>18}"
    native = f"{row.native.variance:>12.4e}" if row.native else ""
    return line + (native if with_native else "") + f"  {row.verdict}"


def _json(row: Comparison) -> dict[str, Any]:
    from dataclasses import asdict

    from samplekit_spectrum.tables import finite

    return {
        "count": row.count,
        "predicted": asdict(row.predicted),
        "measured": _measurement(row.measured),
        "native": _measurement(row.native) if row.native else None,
        "ratio": finite(row.ratio),
        "ratio_low": finite(row.ratio_low),
        "ratio_high": finite(row.ratio_high),
        "verdict": row.verdict,
    }


def _measurement(measured: Measurement) -> dict[str, Any]:
    from dataclasses import asdict

    from samplekit_spectrum.tables import finite

    return {name: value if isinstance(value, int) else finite(value) for name, value in asdict(measured).items()}
