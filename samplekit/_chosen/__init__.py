"""Samplers and scenes as a user chose them: options checked, faults of plugins named."""
