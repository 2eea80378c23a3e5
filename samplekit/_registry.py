"""Discovery, lookup and lists of what plugins offer. A plugin that fails is reported, and the others work on.

What a plugin prints while it is loaded goes to standard error, so that results stand alone on standard output.

The built-in samplers, scenes and randomizers come through the same hooks as those of any plugin. They are registered
first: their names are found without loading any other plugin, and no plugin can take one of their names.
"""

from __future__ import annotations

import contextlib
import functools
import os
import sys
from dataclasses import dataclass, field, replace
from importlib.metadata import entry_points
from typing import TYPE_CHECKING, Any, Literal

import pluggy

from samplekit import __version__, _hooks
from samplekit._errors import AmbiguousNameError, UnknownNameError
from samplekit._quoting import quoted, reason
from samplekit._specs import CommandOption, CommandSpec, RandomizerSpec, SamplerSpec, SceneSpec

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

Kind = Literal["sampler", "randomizer", "scene", "command", "option"]

BUILTIN = "samplekit"
GROUP = "samplekit"
ALLOW_VARIABLE = "SAMPLEKIT_PLUGINS"
BLOCK_VARIABLE = "SAMPLEKIT_BLOCK"

SPEC_TYPES: dict[Kind, type[Any]] = {
    "sampler": SamplerSpec,
    "randomizer": RandomizerSpec,
    "scene": SceneSpec,
    "command": CommandSpec,
    "option": CommandOption,
}


@dataclass
class Plugin:
    """An installed plugin, as ``samplekit list plugins`` shows it.

    Attributes
    ----------
    name, distribution, version
        Name of its entry point, and the distribution that it comes with.
    problems
        One line for each fault; empty if the plugin works.
    blocked
        Whether an environment variable switches the plugin off.
    offers
        The names that it offers, by kind.

    Examples
    --------
    >>> import samplekit
    >>> [plugin.name for plugin in samplekit.plugins() if plugin.builtin]
    ['samplekit']
    """

    name: str
    distribution: str
    version: str
    problems: list[str] = field(default_factory=list)
    blocked: bool = False
    offers: dict[str, list[str]] = field(default_factory=dict)

    @property
    def builtin(self) -> bool:
        """True for the plugin that comes with samplekit."""
        return self.name == BUILTIN

    def __str__(self) -> str:
        return f"{self.name} ({self.distribution} {self.version})"


@dataclass(frozen=True)
class Registration:
    """A declaration, the plugin that it comes from, and the name that chooses it: ``NAME`` or ``PLUGIN/NAME``."""

    spec: Any
    plugin: Plugin
    name: str


class Registry:
    """All declarations by kind and name: built-in ones at once, those of plugins when a lookup needs them."""

    def __init__(self) -> None:
        from samplekit import _builtin as builtin

        self._manager = pluggy.PluginManager(GROUP)
        self._manager.add_hookspecs(_hooks)
        self._registered: dict[Kind, dict[str, list[Registration]]] = {kind: {} for kind in SPEC_TYPES}
        self.plugins: list[Plugin] = []
        self._discovered = False
        self.plugins.append(Plugin(BUILTIN, "samplekit-core", __version__))
        self._add(self.plugins[0], builtin)

    def find(self, kind: Kind, name: str) -> Registration:
        """Return the declaration called ``name``, or ``PLUGIN/NAME`` where two plugins offer the same name.

        Raises
        ------
        UnknownNameError
            No plugin that works offers the name.
        AmbiguousNameError
            Several plugins offer it.
        """
        plugin_name, slash, plain = name.rpartition("/")
        if plugin_name not in ("", BUILTIN) or not self._registered[kind].get(plain):
            self.discover()
        found = self._registered[kind].get(plain, [])
        if slash:
            found = [each for each in found if each.plugin.name == plugin_name]
        if not found:
            raise UnknownNameError(kind, name, self._registered[kind], self._plugin_hints())
        if len(found) > 1:
            choices = [f"{each.plugin.name}/{plain}" for each in found]
            raise AmbiguousNameError(kind, plain, [str(each.plugin) for each in found], choices)
        return replace(found[0], name=name) if plugin_name not in ("", BUILTIN) else found[0]

    def all(self, kind: Kind) -> dict[str, Registration]:
        """Return every declaration of a kind by the name that chooses it, sorted."""
        self.discover()
        named = {
            (name if len(found) == 1 else f"{each.plugin.name}/{name}"): each
            for name, found in self._registered[kind].items()
            for each in found
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
            taken = any(other.name == entry.name for other in self.plugins)
            self.plugins.append(plugin)
            if entry.name in blocked or (allowed is not None and entry.name not in allowed):
                plugin.blocked = True
            elif taken:
                plugin.problems.append(f"another plugin has the name {entry.name!r} already")
            else:
                self._load(plugin, entry)

    def _load(self, plugin: Plugin, entry: EntryPoint) -> None:
        try:
            with contextlib.redirect_stdout(sys.stderr):
                module = entry.load()
        except (Exception, SystemExit) as error:
            plugin.problems.append(f"cannot be imported: {reason(error)}")
        else:
            self._add(plugin, module)

    def _add(self, plugin: Plugin, module: object) -> None:
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
        for kind in SPEC_TYPES:
            caller = getattr(self._manager.hook, f"samplekit_{kind}s")
            for implementation in caller.get_hookimpls():
                if implementation.plugin is module:
                    self._collect(kind, plugin, implementation.function)

    def _collect(self, kind: Kind, plugin: Plugin, hook: Any) -> None:
        try:
            with contextlib.redirect_stdout(sys.stderr):
                specs = list(hook())
        except (Exception, SystemExit) as error:
            plugin.problems.append(f"samplekit_{kind}s failed: {reason(error)}")
            return
        for spec in specs:
            if not isinstance(spec, SPEC_TYPES[kind]):
                plugin.problems.append(f"samplekit_{kind}s gave {quoted(spec)}, not a {SPEC_TYPES[kind].__name__}")
                continue
            present = self._registered[kind].setdefault(spec.name, [])
            if any(other.plugin.builtin for other in present):
                plugin.problems.append(f"{kind} {spec.name!r}: the name belongs to samplekit's own {kind}")
            elif any(other.plugin is plugin for other in present):
                plugin.problems.append(f"{kind} {spec.name!r} is declared twice")
            else:
                present.append(Registration(spec, plugin, spec.name))
                plugin.offers.setdefault(kind, []).append(spec.name)

    def _plugin_hints(self) -> str:
        """Name the plugins that might have offered what is missing, as the end of a message."""
        hints = ""
        failed = [f"{plugin}: {plugin.problems[0]}" for plugin in self.plugins if plugin.problems]
        if failed:
            hints += f" (plugins with problems: {'; '.join(failed)})"
        blocked = [plugin.name for plugin in self.plugins if plugin.blocked]
        if blocked:
            hints += f" (plugins switched off by {ALLOW_VARIABLE} or {BLOCK_VARIABLE}: {', '.join(blocked)})"
        return hints


@functools.cache
def registry() -> Registry:
    """Return the registry of this process."""
    return Registry()


def samplers() -> list[SamplerSpec]:
    """Return the declarations of all samplers, sorted by name.

    Examples
    --------
    >>> import samplekit
    >>> [spec.name for spec in samplekit.samplers() if spec.progressive == samplekit.AnyCount()][:2]
    ['halton', 'r2']
    """
    return [registration.spec for registration in registry().all("sampler").values()]


def scenes() -> list[SceneSpec]:
    """Return the declarations of all scenes, sorted by name.

    Examples
    --------
    >>> import samplekit
    >>> [option.name for spec in samplekit.scenes() if spec.name == "zoneplate" for option in spec.options]
    ['k', 'cx', 'cy', 'pixel-filter']
    """
    return [registration.spec for registration in registry().all("scene").values()]


def randomizers() -> list[RandomizerSpec]:
    """Return the declarations of all randomizers, sorted by name.

    Examples
    --------
    >>> import samplekit
    >>> [spec.name for spec in samplekit.randomizers()]
    ['owen', 'shift', 'xor']
    """
    return [registration.spec for registration in registry().all("randomizer").values()]


def plugins() -> list[Plugin]:
    """Return all installed plugins, also those that failed, with their problems.

    Examples
    --------
    >>> import samplekit
    >>> "lattice" in [plugin.name for plugin in samplekit.plugins()]
    True
    """
    registry().discover()
    return registry().plugins


def _distribution(entry: EntryPoint) -> tuple[str, str]:
    try:
        # Half-removed distributions have neither.
        return (entry.dist and entry.dist.name) or "unknown", (entry.dist and entry.dist.version) or "?"
    except Exception:
        return "unknown", "?"


def _names_in(variable: str) -> set[str] | None:
    value = os.environ.get(variable)
    return None if value is None else {name.strip() for name in value.split(",") if name.strip()}
