"""Base classes that samplers, scenes and randomizers derive from, and the realisations that they are handed."""
