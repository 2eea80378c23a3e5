"""Drawings for plots and figures: laid out once, then written as pixels or as SVG."""
