"""The hooks of plugins. Each hook returns declarations; an implementation is imported when it is first used.

A distribution offers its plugin under the entry-point group ``samplekit``, naming a light module
that imports no NumPy at its top.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import pluggy

if TYPE_CHECKING:
    from collections.abc import Iterable

    from samplekit._specs import CommandOption, CommandSpec, RandomizerSpec, SamplerSpec, SceneSpec

hookspec = pluggy.HookspecMarker("samplekit")
hookimpl = pluggy.HookimplMarker("samplekit")
"""Marks a function of a plugin as one that samplekit calls: ``@hookimpl`` above ``def samplekit_samplers()``."""


@hookspec
def samplekit_samplers() -> Iterable[SamplerSpec]:  # type: ignore[empty-body]
    """Samplers: sets and sequences of points."""


@hookspec
def samplekit_randomizers() -> Iterable[RandomizerSpec]:  # type: ignore[empty-body]
    """Randomizers, written behind a sampler as ``SAMPLER+RANDOMIZER``."""


@hookspec
def samplekit_scenes() -> Iterable[SceneSpec]:  # type: ignore[empty-body]
    """Scenes: integrands with their exact mean over a pixel."""


@hookspec
def samplekit_commands() -> Iterable[CommandSpec]:  # type: ignore[empty-body]
    """Commands of the command line."""


@hookspec
def samplekit_options() -> Iterable[CommandOption]:  # type: ignore[empty-body]
    """Options that are added to commands."""
