"""Discovery and lookup of what plugins offer; a plugin that fails is reported, and harms nobody else.

Our own samplers, scenes and randomizers come through the same hooks as strangers', registered first:
a name of theirs is found without looking at any other plugin, and nobody can take it.
"""

from __future__ import annotations

import contextlib
import difflib
import functools
import os
import sys
from dataclasses import dataclass, field, replace
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any, Literal

import pluggy

from samplekit import _hooks
from samplekit._errors import UsageError
from samplekit._quoting import quoted, reason
from samplekit._specs import CommandSpec, RandomizerSpec, SamplerSpec, SceneSpec

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

Kind = Literal["sampler", "randomizer", "scene", "command"]

BUILTIN = "samplekit"
GROUP = "samplekit"
ALLOW_VARIABLE = "SAMPLEKIT_PLUGINS"
BLOCK_VARIABLE = "SAMPLEKIT_BLOCK"

_TYPES: dict[Kind, type] = {
    "sampler": SamplerSpec,
    "randomizer": RandomizerSpec,
    "scene": SceneSpec,
    "command": CommandSpec,
}


@dataclass
class Plugin:
    """A plugin as ``samplekit list plugins`` shows it: ``problems`` is empty when all is well."""

    name: str
    distribution: str
    version: str
    problems: list[str] = field(default_factory=list)
    blocked: bool = False
    offers: dict[str, list[str]] = field(default_factory=dict)

    def __str__(self) -> str:
        return f"{self.name} ({self.distribution} {self.version})"


@dataclass(frozen=True)
class Offer:
    """A declaration and the plugin that it comes from."""

    spec: Any
    plugin: Plugin
    asked_for: str = ""

    @property
    def called(self) -> str:
        """The name that chooses it: with the plugin's where it was asked for so."""
        return self.asked_for or str(self.spec.name)


class Registry:
    """All declarations, by kind and name. Built-in ones are there at once, plugins' when a lookup needs them."""

    def __init__(self) -> None:
        from samplekit import _builtin as builtin

        self._manager = pluggy.PluginManager(GROUP)
        self._manager.add_hookspecs(_hooks)
        self._offers: dict[Kind, dict[str, list[Offer]]] = {kind: {} for kind in _TYPES}
        self.plugins: list[Plugin] = []
        self._discovered = False
        ours = Plugin(BUILTIN, "samplekit-core", _own_version())
        self._add(ours, builtin)

    def find(self, kind: Kind, name: str) -> Offer:
        """The declaration called ``name``, or ``PLUGIN/NAME`` where two plugins have one of that name.

        Raises
        ------
        UsageError
            Unknown (the nearest names, and the plugins that failed to load), or offered by two plugins.
        """
        plugin_name, slash, plain = name.rpartition("/")
        offers = self._offers[kind].get(plain, [])
        if not offers or (plugin_name and plugin_name != BUILTIN):
            self.discover()
            offers = self._offers[kind].get(plain, [])
        if plugin_name:
            offers = [offer for offer in offers if offer.plugin.name == plugin_name]
        if slash and not plugin_name:
            offers = []
        if len(offers) == 1:
            (offer,) = offers
            return replace(offer, asked_for=name) if plugin_name not in ("", BUILTIN) else offer
        if offers:
            both = " and ".join(str(offer.plugin) for offer in offers)
            choices = " or ".join(f"{offer.plugin.name}/{plain}" for offer in offers)
            raise UsageError(f"{kind} {plain!r} is offered by {both}: write {choices}")
        raise UsageError(self._unknown(kind, name))

    def all(self, kind: Kind) -> dict[str, Offer]:
        """Every declaration of a kind by the name that chooses it, sorted; ``PLUGIN/NAME`` where a name is shared."""
        self.discover()
        named = {
            (name if len(offers) == 1 else f"{offer.plugin.name}/{name}"): offer
            for name, offers in self._offers[kind].items()
            for offer in offers
        }
        return dict(sorted(named.items()))

    def discover(self) -> None:
        """Load the light modules of all installed plugins, once."""
        if self._discovered:
            return
        self._discovered = True
        allowed, blocked = _names_in(ALLOW_VARIABLE), _names_in(BLOCK_VARIABLE) or set()
        found = sorted(entry_points(group=GROUP), key=lambda entry: (entry.name, _distribution(entry)))
        for entry in found:
            plugin = Plugin(entry.name, *_distribution(entry))
            if entry.name in blocked or (allowed is not None and entry.name not in allowed):
                plugin.blocked = True
                self.plugins.append(plugin)
                continue
            if any(other.name == entry.name for other in self.plugins):
                plugin.problems.append(f"another plugin has the name {entry.name!r} already")
                self.plugins.append(plugin)
                continue
            try:
                with _printing_apart():
                    module = entry.load()
            except (Exception, SystemExit) as error:
                plugin.problems.append(f"cannot be imported: {reason(error)}")
                self.plugins.append(plugin)
                continue
            self._add(plugin, module)

    def _add(self, plugin: Plugin, module: object) -> None:
        self.plugins.append(plugin)
        try:
            self._manager.register(module, name=plugin.name)
        except (Exception, SystemExit) as error:
            # Registering is not transactional: take back what pluggy kept.
            self._manager.unregister(name=plugin.name)
            plugin.problems.append(f"cannot be registered: {reason(error)}")
            return
        callers = self._manager.get_hookcallers(module) or []
        unknown = sorted(caller.name for caller in callers if not caller.has_spec())
        if unknown:
            known = ", ".join(sorted(name for name in vars(_hooks) if name.startswith("samplekit_")))
            plugin.problems.append(f"unknown hook {', '.join(unknown)}: the hooks are {known}")
        if not callers:
            plugin.problems.append("offers nothing: no function is marked with samplekit.hookimpl")
        for kind in _TYPES:
            caller = getattr(self._manager.hook, f"samplekit_{kind}s")
            for implementation in caller.get_hookimpls():
                if implementation.plugin is module:
                    self._collect(kind, plugin, implementation.function)

    def _collect(self, kind: Kind, plugin: Plugin, hook: Any) -> None:
        try:
            with _printing_apart():
                specs = list(hook())
        except (Exception, SystemExit) as error:
            plugin.problems.append(f"samplekit_{kind}s failed: {reason(error)}")
            return
        for spec in specs:
            if not isinstance(spec, _TYPES[kind]):
                plugin.problems.append(f"samplekit_{kind}s gave {quoted(spec)}, not a {_TYPES[kind].__name__}")
                continue
            self._accept(kind, plugin, spec)

    def _accept(self, kind: Kind, plugin: Plugin, spec: Any) -> None:
        present = self._offers[kind].setdefault(spec.name, [])
        if any(offer.plugin.name == BUILTIN for offer in present):
            plugin.problems.append(f"{kind} {spec.name!r}: the name belongs to samplekit's own {kind}")
            return
        if any(offer.plugin is plugin for offer in present):
            plugin.problems.append(f"{kind} {spec.name!r} is declared twice")
            return
        present.append(Offer(spec, plugin))
        plugin.offers.setdefault(kind, []).append(spec.name)

    def _unknown(self, kind: Kind, name: str) -> str:
        names = [name for name, offers in self._offers[kind].items() if offers]
        near = difflib.get_close_matches(name, names, n=3, cutoff=0.5)
        message = f"unknown {kind} {name!r}"
        message += f": did you mean {' or '.join(near)}?" if near else f": there are {', '.join(sorted(names))}"
        failed = [f"{plugin}: {plugin.problems[0]}" for plugin in self.plugins if plugin.problems]
        if failed:
            message += f" (plugins with problems: {'; '.join(failed)})"
        blocked = [plugin.name for plugin in self.plugins if plugin.blocked]
        if blocked:
            message += f" (plugins switched off by {ALLOW_VARIABLE} or {BLOCK_VARIABLE}: {', '.join(blocked)})"
        return message


@functools.cache
def registry() -> Registry:
    """The registry of this process."""
    return Registry()


def _printing_apart() -> contextlib.AbstractContextManager[object]:
    """What a plugin prints goes to standard error: results go to standard output, and must stand alone there."""
    return contextlib.redirect_stdout(sys.stderr)


def _own_version() -> str:
    from samplekit import __version__

    return __version__


def _distribution(entry: EntryPoint) -> tuple[str, str]:
    try:
        # Half-removed distributions have neither.
        return (entry.dist and entry.dist.name) or "unknown", (entry.dist and entry.dist.version) or "?"
    except Exception:
        return "unknown", "?"


def _names_in(variable: str) -> set[str] | None:
    value = os.environ.get(variable)
    return None if value is None else {name.strip() for name in value.split(",") if name.strip()}
