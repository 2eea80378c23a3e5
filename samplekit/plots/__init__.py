"""Pictures of results, drawn by matplotlib: one display for each kind of result.

A display follows the conventions of scikit-learn: it is made from a result, ``plot(ax=...)`` draws it and returns it,
and then ``ax_`` (or ``axes_``, where there are several) and ``figure_`` are what was drawn. ``save`` writes PNG, SVG or
PDF. Matplotlib is imported when the first display is drawn.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
