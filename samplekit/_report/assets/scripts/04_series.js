// One colour and one marker for each sampler, the same in every chart.

const symbolTriangleDown = {
  draw(context, size) {
    const y = -Math.sqrt(size / (3 * Math.sqrt(3)));
    context.moveTo(0, -2 * y);
    context.lineTo(-Math.sqrt(3) * y, y);
    context.lineTo(Math.sqrt(3) * y, y);
    context.closePath();
  },
};

const MARKERS = [
  d3.symbolCircle,
  d3.symbolSquare,
  d3.symbolTriangle,
  d3.symbolDiamond,
  d3.symbolCross,
  d3.symbolStar,
  d3.symbolWye,
  symbolTriangleDown,
];
const DASHES = ["", "7 3", "2 3", "9 3 2 3"];

function seriesColour(index) {
  return `var(--series-${index % MARKERS.length})`;
}

// Past eight samplers colours and markers repeat in another pairing, with another dash.
function seriesMarker(index, size = 42) {
  const turn = Math.floor(index / MARKERS.length);
  return d3.symbol(MARKERS[(index + 3 * turn) % MARKERS.length], size)();
}

function seriesDash(index) {
  return DASHES[Math.floor(index / MARKERS.length) % DASHES.length];
}
