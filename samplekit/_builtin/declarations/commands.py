"""The commands that come with samplekit, in the order in which help lists them."""

from __future__ import annotations

from samplekit import CommandSpec

_CLI = "samplekit._cli."
COMMANDS = (
    CommandSpec("render", _CLI + "render:render", "a test image, its exact reference and its error"),
    CommandSpec("compare", _CLI + "compare:compare", "error against samples and against run time"),
    CommandSpec("points", _CLI + "points:points", "the points of a sampler"),
    CommandSpec("check", _CLI + "check:check", "whether samplers and scenes are what they declare"),
    CommandSpec("stability", _CLI + "stability:stability", "whether estimates are right where scenes are stiff"),
    CommandSpec("list", _CLI + "listing:list_", "samplers, scenes, randomizers and plugins"),
    CommandSpec("info", _CLI + "info:info", "how an image was made"),
    CommandSpec("new-plugin", _CLI + "new_plugin:new_plugin", "a complete plugin to start from"),
)
