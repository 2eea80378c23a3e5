"""``samplekit predict``: the variance that spectra predict, beside the measured one."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any

import typer

from samplekit.commands import DONE, JsonOption, SamplerOption, SeedOption, complete_scene

if TYPE_CHECKING:
    from samplekit_spectrum.integrands.integrand import Integrand
    from samplekit_spectrum.prediction import Comparison

SCHEMA = "samplekit.prediction/1"


def predict(
    sampler: SamplerOption,
    scene: Annotated[
        str,
        typer.Option(
            "--scene",
            metavar="NAME[:OPTION=VALUE,...]",
            help="The scene to integrate.",
            autocompletion=complete_scene,
        ),
    ],
    count: Annotated[
        str, typer.Option("--count", "-n", metavar="LIST", help="Samples: 1,4,16 or 2^0..2^12 or 4^1..4^5.")
    ],
    trials: Annotated[
        str,
        typer.Option("--trials", metavar="T", help="Number of measured estimates; by default 40000 or more."),
    ] = "",
    realizations: Annotated[
        str,
        typer.Option("--realizations", "-r", metavar="R", help="Sets in the mean of the spectrum; by default enough."),
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

    The prediction is exact only if a random shift follows the sampler, so both variances are those of the shifted
    sampler. The variance of the sampler without the shift (native) is shown beside them.

    Example: samplekit predict --sampler jittered --scene disk --count 4^2..4^5
    """
    from samplekit.commands import announce_compilation

    announce_compilation()
    import samplekit
    from samplekit import check_threads
    from samplekit.commands import Stages, parse_count, parse_counts, parse_seed
    from samplekit_spectrum.homogenized import is_homogeneous
    from samplekit_spectrum.integrands import integrand_of
    from samplekit_spectrum.prediction import LEVEL, check_settings
    from samplekit_spectrum.prediction import predict as predict_one

    counts = parse_counts(count, "count")
    chosen, integrated = samplekit.sampler(sampler).fresh(), samplekit.scene(scene)
    for number in counts:
        # All counts are checked first: otherwise the last could fail after hours of work.
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
        with Stages() as progress:
            row = predict_one(chosen, integrated, number, progress=progress, **settings)
        rows.append(row)
        if not json:
            typer.echo(_line(row, with_native))
    if json:
        from dataclasses import asdict
        from json import dumps

        from samplekit_spectrum.tables import finite

        report = {
            "schema": SCHEMA,
            "sampler": chosen.text,
            "scene": integrated.text,
            "homogenized": True,
            "confidence": LEVEL,
            "seed": settings["seed"],
            "integrand": {
                "mean": integrand.mean,
                "variance": integrand.variance,
                "approximate": integrand.approximate,
                "aliasing": integrand.aliasing,
            },
            "rows": [asdict(row) for row in rows],
        }
        typer.echo(dumps(finite(report), allow_nan=False))
    return DONE


def _heading(sampler: str, scene: str, settings: dict[str, Any], integrand: Integrand, with_native: bool) -> list[str]:
    lines = [f"{scene}, {sampler} with a random shift, seed {settings['seed']}"]
    if integrand.approximate:
        lines.append(f"  the scene's spectrum is approximate: its sum is off by about {integrand.aliasing:.2g}")
    head = f"  {'count':>8}{'predicted':>12}{'+-':>9}{'tail':>9}{'at most':>9}{'measured':>12}{'ratio':>8}{'99 %':>18}"
    lines.append(head + (f"{'native':>12}" if with_native else "") + "  verdict")
    return lines


def _line(row: Comparison, with_native: bool) -> str:
    predicted, measured = row.predicted, row.measured
    # Shares and ratios of two zeros mean nothing.
    exact = row.verdict == "exact" or predicted.variance == 0.0
    parts = (predicted.standard_error, predicted.tail, predicted.tail_bound)
    shares = "".join(f"{'-' if exact or math.isnan(part) else f'{part / predicted.variance:.2%}':>9}" for part in parts)
    ratio = "-" if exact else f"{row.ratio:.4f}"
    interval = "-" if exact or math.isnan(row.ratio_low) else f"{row.ratio_low:.4f} to {row.ratio_high:.4f}"
    line = f"  {row.count:>8}{predicted.variance:>12.4e}{shares}{measured.variance:>12.4e}{ratio:>8}{interval:>18}"
    native = f"{row.native.variance:>12.4e}" if with_native and row.native else ""
    return f"{line}{native}  {row.verdict}"
