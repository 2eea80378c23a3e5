"""``samplekit render``: a test image, its exact reference and its error."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Annotated

import typer

from samplekit.commands._completion import complete_scene
from samplekit.commands._options import JsonOption, SamplerOption, SeedOption
from samplekit.commands._statuses import DONE, FAILED

if TYPE_CHECKING:
    from samplekit import Rendering


def render(
    sampler: SamplerOption,
    spp: Annotated[str, typer.Option("--spp", "-n", metavar="N", help="Samples per pixel.")],
    scene: Annotated[
        str,
        typer.Option(
            "--scene", metavar="NAME[:OPTION=VALUE,...]", help="What is rendered.", autocompletion=complete_scene
        ),
    ] = "zoneplate",
    size: Annotated[str, typer.Option("--size", metavar="W[xH]", help="Size of the image in pixels.")] = "512",
    crop: Annotated[str, typer.Option("--crop", metavar="X,Y,W,H", help="Render this part of the image alone.")] = "",
    seed: SeedOption = "0",
    output: Annotated[
        str,
        typer.Option("--output", "-o", metavar="PATH", help="A folder, or STEM.exr; by default the current folder."),
    ] = "",
    no_error: Annotated[
        bool, typer.Option("--no-error", help="Leave out the reference, the error and the metrics.")
    ] = False,
    full: Annotated[bool, typer.Option("--full", help="Sample pixels in which the scene is constant as well.")] = False,
    threads: Annotated[
        str, typer.Option("--threads", "-t", metavar="T", help="Threads; by default one for each processor.")
    ] = "",
    ssim: Annotated[bool, typer.Option("--ssim", help="Report structural similarity as well.")] = False,
    flip: Annotated[bool, typer.Option("--flip", help="Report the perceived difference FLIP as well.")] = False,
    explain: Annotated[bool, typer.Option("--explain", help="Say what is left out, and why.")] = False,
    json: JsonOption = False,
) -> int:
    """Render a test image by integrating every pixel with samples.

    Writes STEM.exr (image, exact reference, error), STEM.png and STEM.error.png, and prints how large the error is.

    Example: samplekit render --sampler hammersley --spp 16
    """
    from samplekit import render as render_image
    from samplekit.commands import (
        Progress,
        announce_compilation,
        fact_lines,
        parse_count,
        parse_crop,
        parse_seed,
        parse_size,
        plugin_facts,
    )

    width_height = parse_size(size)
    announce_compilation()
    with Progress("rendering") as progress, Progress("preparing point sets") as preparing:
        rendering = render_image(
            scene,
            sampler,
            parse_count(spp, "spp"),
            size=width_height,
            crop=parse_crop(crop, width_height) if crop else None,
            seed=parse_seed(seed),
            threads=parse_count(threads, "threads") if threads else None,
            error=not no_error,
            full=full,
            ssim=ssim,
            flip=flip,
            output=output,
            explain=partial(typer.echo, err=True) if explain else None,
            progress=progress,
            preparing=preparing,
        )
    facts = plugin_facts(rendering)
    if json:
        from json import dumps

        typer.echo(dumps(rendering.as_json() | facts, allow_nan=False))
    else:
        for line in [*_table(rendering), *fact_lines(facts)]:
            typer.echo(line)
    if no_error:
        _warn_of_an_old_error_picture(rendering)
    return _report_invalid_pixels(rendering)


def _table(rendering: Rendering) -> list[str]:
    plan, size = rendering.plan, rendering.plan.pixels.size
    lines = [f"{plan.pixels.scene.text}, {plan.sampler.text}, {plan.count} spp, {size[0]}x{size[1]}, seed {plan.seed}"]
    for name, number in rendering.metrics.items():
        lines.append(f"  {name:<16}{number if isinstance(number, int) else f'{number:.6g}'}")
    setup, points, scene, reference, total = (
        f"{name} {rendering.seconds[name]:.3f}" for name in ("setup", "points", "scene", "reference", "total")
    )
    summed = f" (each summed over {rendering.threads} threads)" if rendering.threads > 1 else ""
    lines.append(f"  {'seconds':<16}{setup}, {points} and {scene}{summed}, {reference}, {total}")
    return [*lines, *(f"  {'wrote':<16}{file}" for file in rendering.files)]


def _warn_of_an_old_error_picture(rendering: Rendering) -> None:
    """Say that a picture beside the new files shows the error of other ones."""
    old = rendering.files[0].with_name(f"{rendering.files[0].stem}.error.png")
    if old.exists():
        typer.echo(f"samplekit: {old} is of an earlier rendering: this one has no error (--no-error)", err=True)


def _report_invalid_pixels(rendering: Rendering) -> int:
    """Return the exit status; say how many pixels are not finite if there are any."""
    metrics, scene = rendering.metrics, rendering.plan.pixels.scene.text
    if not metrics.get("invalid_pixels"):
        return DONE
    samples = metrics.get("invalid_samples", 0)
    what = f"{samples} samples of {scene} were not finite"
    if not samples:
        # The image is at fault, or else the reference: metrics count the pixels of both.
        what = f"the means of {scene}, or its reference, were not finite though all samples were"
    message = f"{what}, in {metrics['invalid_pixels']} pixels: shown in magenta"
    typer.echo(f"samplekit: {message}", err=True)
    return FAILED
