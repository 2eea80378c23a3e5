"""Names of a new plugin, and writing its files: all of them, or none."""

from __future__ import annotations

import keyword
import re
import shutil
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from samplekit import __version__
from samplekit._errors import SamplekitError, UsageError
from samplekit._scaffold.templates import FILES

_NAME = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
_LONGEST = 40
_TAKEN = ("core", "samplekit")
"""Distributions called samplekit-NAME that exist with another meaning."""


@dataclass(frozen=True)
class NewPlugin:
    """The names that follow from one."""

    name: str

    @property
    def distribution(self) -> str:
        """Name of the distribution, for pip."""
        return f"samplekit-{self.name}"

    @property
    def package(self) -> str:
        """Name of the package, for Python."""
        return f"samplekit_{self.name.replace('-', '_')}"

    @property
    def class_name(self) -> str:
        """Name of the sampler's class."""
        return "".join(part.capitalize() for part in self.name.split("-"))


def check_name(name: str) -> NewPlugin:
    """The plugin of this name.

    Raises
    ------
    UsageError
        It cannot be one, or a sampler of that name is there already.
    """
    if not _NAME.fullmatch(name) or len(name) > _LONGEST:
        raise UsageError(
            f"plugin name {name!r}: expected small letters and digits with single dashes between, such as golden-ratio"
        )
    if name in _TAKEN or name.startswith("samplekit-"):
        raise UsageError(f"plugin name {name!r}: samplekit- is put before it; choose a name of its own")
    plugin = NewPlugin(name)
    if keyword.iskeyword(plugin.class_name) or plugin.package in sys.stdlib_module_names:
        raise UsageError(f"plugin name {name!r} is a word of Python's")
    from samplekit._registry import registry

    taken = registry().all("sampler").get(name)
    if taken is not None:
        raise UsageError(f"plugin name {name!r}: there is a sampler of that name already, of plugin {taken.plugin}")
    return plugin


def write_plugin(name: str, folder: Path) -> list[Path]:
    """Write the plugin into ``folder/samplekit-NAME``, whole or not at all.

    Returns
    -------
    The files.

    Raises
    ------
    UsageError
        A bad name, no such folder, or the plugin's folder exists.
    SamplekitError
        It cannot be written.
    """
    plugin = check_name(name)
    if not folder.is_dir():
        raise UsageError(f"--directory {folder}: there is no such folder")
    target = folder / plugin.distribution
    if target.exists() or target.is_symlink():
        raise UsageError(f"{target} exists already: nothing is overwritten")
    values = {
        "@NAME@": plugin.name,
        "@DISTRIBUTION@": plugin.distribution,
        "@PACKAGE@": plugin.package,
        "@CLASS@": plugin.class_name,
        "@CORE@": ".".join(__version__.split(".")[:2]),
    }
    try:
        with tempfile.TemporaryDirectory(dir=folder, prefix=".samplekit-") as made:
            for path, text in FILES.items():
                file = Path(made) / "plugin" / _filled(path, values)
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_text(_filled(text, values), encoding="utf-8", newline="\n")
            shutil.move(Path(made) / "plugin", target)
    except OSError as error:
        raise SamplekitError(f"{target} cannot be written: {error.strerror or error}") from error
    return [target / _filled(path, values) for path in FILES]


def _filled(text: str, values: dict[str, str]) -> str:
    for key, value in values.items():
        text = text.replace(key, value)
    return text
