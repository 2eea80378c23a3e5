"""Which options of a command's help stand together: what is done, how it is carried out, what comes out."""

from __future__ import annotations

from typing import Any

from typer.core import TyperOption

_PANELS = {
    "How it runs": "threads processes dask jobs resume no_time budget isolated time_limit memory_limit",
    "What comes out": "output directory json html explain ssim flip no_error scale",
}
_PANEL_OF = {name: panel for panel, names in _PANELS.items() for name in names.split()}


def arranged(parameters: list[Any]) -> list[Any]:
    """The parameters, each option under its heading; what a command's author has arranged stays so."""
    for parameter in parameters:
        if isinstance(parameter, TyperOption):
            parameter.rich_help_panel = parameter.rich_help_panel or _PANEL_OF.get(parameter.name or "")
            if parameter.is_flag and parameter.metavar is None:
                # A flag takes no value: its type would read as one.
                parameter.metavar = ""
    return parameters
