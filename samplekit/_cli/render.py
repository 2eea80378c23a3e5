"""``samplekit render``: a test image, its exact reference and its error."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from samplekit.commands._completion import complete_scene
from samplekit.commands._options import JsonOption, SamplerOption, SeedOption

if TYPE_CHECKING:
    from samplekit._integrate.plan import Plan
    from samplekit._integrate.rendering import Rendering


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
    from samplekit._parsing import parse_count, parse_crop, parse_seed, parse_size

    if no_error and (ssim or flip):
        from samplekit._errors import UsageError

        raise UsageError("--ssim and --flip compare with the reference, which --no-error leaves out")
    count, width_height = parse_count(spp, "spp"), parse_size(size)
    window = parse_crop(crop, width_height) if crop else None
    start = parse_seed(seed)
    thread_count = parse_count(threads, "threads") if threads else None
    from samplekit.files._images.rendering import check_stem

    # Before kernels are compiled: half a minute for a folder that takes no file is lost.
    check_stem(output, "image")
    from samplekit.commands._notices import announce_compilation

    announce_compilation()
    from samplekit._chosen.sampler import configured_sampler
    from samplekit._chosen.scene import configured_scene
    from samplekit._integrate.plan import make_plan
    from samplekit._integrate.rendering import render_plan
    from samplekit.commands._progress import Progress

    plan = make_plan(
        configured_scene(scene),
        configured_sampler(sampler),
        count,
        size=width_height,
        crop=window,
        seed=start,
        full=full,
        reference=not no_error,
    )
    stem = check_stem(output, _name(plan))
    if explain:
        for line in plan.explain():
            typer.echo(line, err=True)
    with Progress("rendering") as progress, Progress("preparing point sets") as preparing:
        rendering = render_plan(
            plan, threads=thread_count, progress=progress, preparing=preparing, ssim=ssim, flip=flip
        )
    files = _write(stem, rendering)
    _report(rendering, files, json)
    if no_error:
        _warn_of_an_old_error_picture(stem)
    invalid = int(rendering.metrics.get("invalid_pixels", 0))
    if invalid:
        from samplekit._errors import SamplekitError

        message = _of_invalid(plan, int(rendering.metrics.get("invalid_samples", 0)), invalid)
        if json:
            typer.echo(f"samplekit: {message}", err=True)
            return 1
        raise SamplekitError(message)
    return 0


def _of_invalid(plan: Plan, samples: int, pixels: int) -> str:
    what = f"{samples} samples of {plan.scene.text} were not finite"
    if not samples:
        # The image is at fault, or else the reference: metrics count the pixels of both.
        what = f"the means of {plan.scene.text}, or its reference, were not finite though all samples were"
    return f"{what}, in {pixels} pixels: shown in magenta"


def _name(plan: Plan) -> str:
    whole = plan.window == (0, 0, *plan.size)
    # A crop must not take the place of the whole image beside it.
    crop = "" if whole else "-crop-" + "-".join(map(str, plan.window))
    return f"{plan.scene.text}-{plan.sampler.text}-{plan.count}spp{crop}".replace(":", "-").replace("/", "-")


def _warn_of_an_old_error_picture(stem: Path) -> None:
    """Say that a picture beside the new files shows the error of other ones."""
    old = stem.with_name(f"{stem.name}.error.png")
    if old.exists():
        typer.echo(f"samplekit: {old} is of an earlier rendering: this one has no error (--no-error)", err=True)


def _write(stem: Path, rendering: Rendering) -> list[Path]:
    from samplekit._provenance import describe
    from samplekit.files._images.rendering import write_rendering

    plan = rendering.plan
    x, y = plan.window[:2]
    return write_rendering(
        stem,
        rendering.image,
        rendering.reference,
        rendering.error,
        describe(rendering),
        window=(x, y, *plan.size),
    )


def _report(rendering: Rendering, files: list[Path], as_json: bool) -> None:
    from samplekit._provenance import SCHEMA, finite

    plan = rendering.plan
    if as_json:
        import json

        report: dict[str, Any] = {
            "schema": SCHEMA,
            "sampler": plan.sampler.text,
            "scene": plan.scene.text,
            "spp": plan.count,
            "size": list(plan.size),
            "window": list(plan.window),
            "seed": plan.seed,
            **finite(rendering.metrics),
            "reference": rendering.reference_kind,
            "seconds": rendering.seconds,
            "files": [str(file) for file in files],
        }
        typer.echo(json.dumps(report, allow_nan=False))
        return
    typer.echo(
        f"{plan.scene.text}, {plan.sampler.text}, {plan.count} spp, {plan.size[0]}x{plan.size[1]}, seed {plan.seed}"
    )
    for name, number in rendering.metrics.items():
        typer.echo(f"  {name:<16}{number if isinstance(number, int) else f'{number:.6g}'}")
    times = ", ".join(f"{name} {seconds:.3f}" for name, seconds in rendering.seconds.items())
    typer.echo(f"  {'seconds':<16}{times}")
    for file in files:
        typer.echo(f"  {'wrote':<16}{file}")
