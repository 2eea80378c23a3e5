"""Whether a reader can read a picture: every text that is drawn lies on the paper, and on no other text."""

import itertools

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text


@pytest.fixture
def drawn(monkeypatch):
    """Draw a figure, check its texts, and return what they say."""

    def draw(figure):
        boxes = []
        original = Text.draw

        def recording(self, renderer, *arguments, **keywords):
            if self.get_visible() and self.get_text():
                boxes.append((self.get_text(), self.get_window_extent(renderer)))
            return original(self, renderer, *arguments, **keywords)

        with monkeypatch.context() as patch:
            patch.setattr(Text, "draw", recording)
            canvas = FigureCanvasAgg(figure)
            canvas.draw()
        width, height = canvas.get_width_height()
        for text, box in boxes:
            assert box.x0 >= 0 and box.y0 >= 0 and box.x1 <= width and box.y1 <= height, f"{text!r} is cut off"  # noqa: PT018
        for (one, box), (other, second) in itertools.combinations(boxes, 2):
            across = min(box.x1, second.x1) - max(box.x0, second.x0)
            along = min(box.y1, second.y1) - max(box.y0, second.y0)
            assert not (across > 1 and along > 2), f"{one!r} lies on {other!r}"
        return [text for text, _ in boxes]

    return draw


@pytest.fixture
def apart(drawn):
    """Check that no text lies on the data lines of any axes of a figure."""

    def check(figure):
        drawn(figure)
        renderer = FigureCanvasAgg(figure).get_renderer()
        for ax in figure.axes:
            curves = [line for line in ax.lines if line.get_transform() == ax.transData]
            texts = [*ax.texts, *(ax.get_legend().get_texts() if ax.get_legend() else [])]
            for curve, text in itertools.product(curves, texts):
                points = curve.get_transform().transform(curve.get_xydata())
                box = text.get_window_extent(renderer)
                for start, end in itertools.pairwise(points):
                    places = start + np.linspace(0.0, 1.0, 50)[:, None] * (end - start)
                    inside = ((places > box.min) & (places < box.max)).all(axis=1)
                    assert not inside.any(), f"{text.get_text()!r} lies on a curve"

    return check
