"""Declarations of what comes with samplekit, by kind."""
