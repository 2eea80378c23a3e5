// A log-log chart: lines, markers, bands and whiskers of intervals, guide lines of whole exponents.

const CHART_GAP = 14;
const REACH = 42;
const NAME_INDENT = 14;
const NAME_LETTER = 7.6;
const LONGEST_NAME = 18;

class Chart {
  // host: element; label: what a screen reader says; onFocus(point or null, chart): called as the pointer moves.
  // ticks: the values of x to be named where there is room, or null: powers of ten.
  constructor(host, { label, xTitle, yTitle, formatX, ticks, guides, guideName, onFocus }) {
    Object.assign(this, { host, label, xTitle, yTitle, formatX, ticks, guides, guideName, onFocus });
    this.series = [];
    this.points = [];
    this.target = null;
    this.focused = null;
    this.svg = d3.select(host).append("svg").attr("role", "application").attr("tabindex", 0);
    this.svg
      .on("pointermove pointerdown", (event) => this.pointed(event))
      // A finger that is lifted leaves what it read; the next touch elsewhere ends it.
      .on("pointerleave", (event) => event.pointerType !== "touch" && this.onFocus(null, this))
      .on("keydown", (event) => this.keyed(event))
      .on("blur", () => this.onFocus(null, this));
    drawnToFit(host, 440, (width) => this.draw(width));
  }

  // series: [{index, name, points: [{x, y, low, high, left, right, hollow, row}]}]; target: a value of y or null.
  update(series, { yTitle = this.yTitle, target = null } = {}) {
    Object.assign(this, { series, yTitle, target });
    this.draw();
  }

  draw(width = this.width) {
    if (!width) return;
    const height = Math.round(Math.min(460, Math.max(270, width * 0.74)));
    const named = width >= 440 && this.series.length > 0;
    const longest = Math.max(0, ...this.series.map((one) => one.name.length));
    const room = {
      top: 12,
      bottom: 44,
      left: 58,
      right: named ? NAME_INDENT + NAME_LETTER * Math.min(longest, LONGEST_NAME) : 14,
    };
    Object.assign(this, { width, height, room, named });
    this.svg
      .attr("viewBox", `0 0 ${width} ${height}`)
      .attr("aria-label", `${this.label}. Arrow keys move from point to point and from sampler to sampler.`);
    this.svg.selectAll("*").remove();
    this.points = this.series.flatMap((one) => one.points.filter(drawable).map((point) => ({ ...point, series: one })));
    const positive = this.points.filter((point) => point.y > 0);
    if (positive.length === 0) {
      this.nothing();
      return;
    }
    const zero = this.points.some((point) => point.y === 0);
    this.scales(positive, zero);
    drawAxes(this, zero);
    drawGuides(this, positive);
    drawTarget(this);
    for (const one of this.series) drawSeries(this, one);
    if (named) drawNames(this);
    this.ring = this.svg.append("circle").attr("class", "focus-ring").attr("r", 9).attr("display", "none");
    this.nearest = d3.Delaunay.from(
      this.points,
      (point) => this.px(point),
      (point) => this.py(point),
    );
    this.focus(this.points.find((point) => this.focused && point.row === this.focused.row) ?? null);
  }

  nothing() {
    this.nearest = null;
    this.svg
      .append("text")
      .attr("class", "nothing")
      .attr("x", this.width / 2)
      .attr("y", this.height / 2)
      .attr("text-anchor", "middle")
      .text(this.series.length ? "no values above zero to draw" : "no sampler is switched on");
  }

  scales(positive, zero) {
    const { width, height, room } = this;
    const bottom = height - room.bottom - (zero ? 24 : 0);
    this.floor = bottom;
    this.x = d3.scaleLog(
      padded(
        positive.flatMap((point) => [point.x, point.left, point.right].filter((x) => x > 0)),
        0.05,
      ),
      [room.left, width - room.right],
    );
    // Whiskers that reach zero would stretch the axis for nothing: they are cut at its end.
    const values = positive.map((point) => point.y);
    const highs = positive.map((point) => point.high).filter((high) => high > 0);
    const lows = positive.map((point) => Math.max(point.low, point.y / 10)).filter((low) => low > 0);
    this.y = d3.scaleLog(padded([...values, ...highs, ...lows], 0.05), [bottom, room.top]);
  }

  px(point) {
    return this.x(point.x);
  }

  // Exact results have no logarithm: they lie on a rail below the axis.
  py(point) {
    return point.y > 0 ? this.y(point.y) : this.floor + CHART_GAP;
  }

  focus(point) {
    this.focused = point;
    if (!this.ring) return;
    this.svg.selectAll(".series").classed("dimmed", function () {
      return point !== null && Number(this.dataset.series) !== point.series.index;
    });
    this.ring.attr("display", point ? null : "none");
    if (point) this.ring.attr("cx", this.px(point)).attr("cy", this.py(point));
  }

  pointed(event) {
    if (!this.nearest) return;
    const [x, y] = d3.pointer(event, this.svg.node());
    const point = this.points[this.nearest.find(x, y)];
    const near = point && Math.hypot(this.px(point) - x, this.py(point) - y) <= REACH;
    this.onFocus(near ? point : null, this);
  }

  keyed(event) {
    const step = { ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowUp: [-1, 0], ArrowDown: [1, 0] }[event.key];
    if (event.key === "Escape") this.onFocus(null, this);
    if (!step || this.points.length === 0) return;
    event.preventDefault();
    if (!this.focused) {
      this.onFocus(this.points[0], this);
      return;
    }
    const [across, along] = step;
    const lists = this.series
      .map((one) => ({ index: one.index, points: one.points.filter(drawable) }))
      .filter((one) => one.points.length > 0);
    const at = lists.findIndex((one) => one.index === this.focused.series.index);
    const list = lists[(at + across + lists.length) % lists.length];
    const old = lists[at].points.findIndex((point) => point.row === this.focused.row);
    const next = Math.min(list.points.length - 1, Math.max(0, old + along));
    this.onFocus(this.points.find((point) => point.row === list.points[next].row) ?? null, this);
  }

  // Where a point is on the page, for the tooltip.
  place(point) {
    const box = this.svg.node().getBoundingClientRect();
    const scale = box.width / this.width;
    return { x: box.left + this.px(point) * scale, y: box.top + this.py(point) * scale };
  }
}

function drawable(point) {
  return point.x > 0 && point.y !== null && point.y >= 0;
}
