// Drawings as wide as their place, on the screen and on paper.

// On paper the place is not known in time: it is drawn for a stated width, which the browser then scales.
function drawnToFit(host, widthOnPaper, draw) {
  const fit = () => {
    const width = Math.round(host.clientWidth);
    if (width >= 80) draw(width);
  };
  new ResizeObserver(fit).observe(host);
  window.addEventListener("beforeprint", () => draw(widthOnPaper));
  window.addEventListener("afterprint", fit);
}
