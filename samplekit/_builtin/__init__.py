"""The samplers, randomizers, scenes and commands that come with samplekit, declared by the hooks of any plugin."""

from __future__ import annotations

from samplekit import CommandSpec, RandomizerSpec, SamplerSpec, SceneSpec, hookimpl
from samplekit._builtin.declarations.commands import COMMANDS
from samplekit._builtin.declarations.randomizers import RANDOMIZERS
from samplekit._builtin.declarations.samplers import SAMPLERS
from samplekit._builtin.declarations.scenes import SCENES


@hookimpl
def samplekit_samplers() -> tuple[SamplerSpec, ...]:
    """Declare the built-in samplers."""
    return SAMPLERS


@hookimpl
def samplekit_randomizers() -> tuple[RandomizerSpec, ...]:
    """Declare the built-in randomizers."""
    return RANDOMIZERS


@hookimpl
def samplekit_scenes() -> tuple[SceneSpec, ...]:
    """Declare the built-in scenes."""
    return SCENES


@hookimpl
def samplekit_commands() -> tuple[CommandSpec, ...]:
    """Declare the built-in commands."""
    return COMMANDS
