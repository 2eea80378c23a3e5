"""Write the files of a new plugin: all of them, or none."""

from __future__ import annotations

import keyword
import re
import tempfile
from pathlib import Path
from string import Template

from samplekit import __version__
from samplekit._errors import SamplekitError, UsageError
from samplekit._registry import registry
from samplekit._scaffold.templates import FILES

_NAME = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")
_LONGEST = 40
_TAKEN = ("core", "samplekit")
"""Distributions called samplekit-NAME that exist with another meaning."""


def write_plugin(name: str, folder: Path) -> list[Path]:
    """Write the plugin into ``folder/samplekit-NAME``, whole or not at all.

    Returns
    -------
    The files.

    Raises
    ------
    UsageError
        A bad name, the name of a sampler that exists, no such folder, or the plugin's folder exists.
    SamplekitError
        It cannot be written.
    """
    names = {
        "name": name,
        "distribution": f"samplekit-{name}",
        "package": f"samplekit_{name.replace('-', '_')}",
        "class_name": "".join(part.capitalize() for part in name.split("-")),
        "core": ".".join(__version__.split(".")[:2]),
    }
    _check_name(name, names["class_name"])
    if not folder.is_dir():
        raise UsageError(f"--directory {folder}: there is no such folder")
    target = folder / names["distribution"]
    if target.exists() or target.is_symlink():
        raise UsageError(f"{target} exists already: nothing is overwritten")
    files = {Template(path).substitute(names): Template(text).substitute(names) for path, text in FILES.items()}
    try:
        with tempfile.TemporaryDirectory(dir=folder, prefix=".samplekit-") as made:
            plugin = Path(made) / "plugin"
            for path, text in files.items():
                (plugin / path).parent.mkdir(parents=True, exist_ok=True)
                (plugin / path).write_text(text, encoding="utf-8", newline="\n")
            plugin.rename(target)
    except OSError as error:
        raise SamplekitError(f"{target} cannot be written: {error.strerror or error}") from error
    return [target / path for path in files]


def _check_name(name: str, class_name: str) -> None:
    """Raise unless a plugin can have this name.

    Raises
    ------
    UsageError
        It cannot be a name, or there is a sampler of that name already.
    """
    if not _NAME.fullmatch(name) or len(name) > _LONGEST:
        raise UsageError(
            f"plugin name {name!r}: expected small letters and digits with single dashes between, such as golden-ratio"
        )
    if name in _TAKEN or name.startswith("samplekit-"):
        raise UsageError(f"plugin name {name!r}: samplekit- is put before it; choose a name of its own")
    if keyword.iskeyword(class_name):
        raise UsageError(f"plugin name {name!r}: its class would be called {class_name}, which is a keyword of Python")
    taken = registry().all("sampler").get(name)
    if taken is not None:
        raise UsageError(f"plugin name {name!r}: there is a sampler of that name already, of plugin {taken.plugin}")
