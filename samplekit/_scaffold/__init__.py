"""A new plugin, complete: what ``samplekit new-plugin`` writes."""

from samplekit._scaffold.plugin import NewPlugin, check_name, write_plugin

__all__ = ["NewPlugin", "check_name", "write_plugin"]
