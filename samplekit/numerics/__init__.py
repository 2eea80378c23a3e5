"""Arithmetic that samplers, scenes and references share: kernels, sums, elementary functions, double-double."""
