"""A new plugin, complete: what ``samplekit new-plugin`` writes."""
