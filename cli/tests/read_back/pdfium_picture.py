"""Renders a page of 85 mm at 144 pixels per inch with pdfium and compares it with the PNG of the same picture."""

import sys

import numpy as np
import pypdfium2
from PIL import Image

pdf, png = sys.argv[1:]
document = pypdfium2.PdfDocument(pdf)
assert len(document) == 1
page = document[0]
assert abs(page.get_width() / 72 * 25.4 - 85) < 1e-3, page.get_width()
rendered = page.render(scale=144 / 72).to_pil().convert("RGB")
expected = Image.open(png).convert("RGB")
assert max(abs(a - b) for a, b in zip(rendered.size, expected.size)) <= 1, (rendered.size, expected.size)


def squares(image):
    """Means over squares of 4 pixels, in which different smoothing of edges does not show."""
    pixels = np.asarray(image.crop((0, 0, 480, 280)), dtype=float)
    return pixels.reshape(280 // 4, 4, 480 // 4, 4, 3).mean(axis=(1, 3))


difference = np.abs(squares(rendered) - squares(expected))
inked = np.abs(squares(expected) - 255).max(axis=2) > 40
assert inked.mean() > 0.02, inked.mean()
assert difference.mean() < 1.5, difference.mean()
assert difference.max() < 64, difference.max()
