// A log-log chart: lines, markers, bands and whiskers of intervals, guide lines of whole exponents.

const CHART_GAP = 14;
const REACH = 42;

class Chart {
  // host: element; label: what a screen reader says; onFocus(point or null, chart): called as the pointer moves.
  constructor(host, { label, xTitle, yTitle, formatX, guides, guideName, onFocus }) {
    Object.assign(this, { host, label, xTitle, yTitle, formatX, guides, guideName, onFocus });
    this.series = [];
    this.points = [];
    this.target = null;
    this.focused = null;
    this.svg = d3.select(host).append("svg").attr("role", "application").attr("tabindex", 0);
    this.svg
      .on("pointermove pointerdown", (event) => this.pointed(event))
      .on("pointerleave", () => this.onFocus(null, this))
      .on("keydown", (event) => this.keyed(event))
      .on("blur", () => this.onFocus(null, this));
    new ResizeObserver(() => this.draw()).observe(host);
  }

  // series: [{index, name, points: [{x, y, low, high, left, right, hollow, row}]}]; target: a value of y or null.
  update(series, { yTitle = this.yTitle, target = null } = {}) {
    Object.assign(this, { series, yTitle, target });
    this.draw();
  }

  draw() {
    const width = Math.round(this.host.clientWidth);
    if (width < 80) return;
    const height = Math.round(Math.min(460, Math.max(270, width * 0.74)));
    const named = width >= 440 && this.series.length > 0;
    const longest = Math.max(0, ...this.series.map((one) => one.name.length));
    const room = { top: 12, bottom: 44, left: 58, right: named ? Math.min(150, 18 + 6.6 * longest) : 14 };
    Object.assign(this, { width, height, room, named });
    this.svg
      .attr("viewBox", `0 0 ${width} ${height}`)
      .attr("height", height)
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
    this.axes(zero);
    this.guideLines(positive);
    this.targetLine();
    for (const one of this.series) this.oneSeries(one);
    if (named) this.names();
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
    this.x = d3.scaleLog(padded(positive.flatMap((point) => [point.x, point.left, point.right].filter((x) => x > 0)), 0.05), [
      room.left,
      width - room.right,
    ]);
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

  axes(zero) {
    const { width, height, room } = this;
    const right = width - room.right;
    for (const [scale, horizontal] of [
      [this.x, true],
      [this.y, false],
    ]) {
      const ticks = logTicks(scale.domain(), horizontal ? width / 70 : height / 42);
      const grid = this.svg.append("g").attr("class", "grid");
      const minor = this.svg.append("g").attr("class", "grid minor");
      for (const value of ticks.minor) rule(minor, scale(value), horizontal, [room.left, right, room.top, this.floor]);
      for (const value of ticks.major) {
        rule(grid, scale(value), horizontal, [room.left, right, room.top, this.floor]);
        const text = this.svg.append("text").text(horizontal ? this.formatX(value) : tickText(value));
        if (horizontal) text.attr("x", scale(value)).attr("y", height - room.bottom + 18).attr("text-anchor", "middle");
        else text.attr("x", room.left - 8).attr("y", scale(value) + 4).attr("text-anchor", "end");
      }
    }
    this.svg
      .append("rect")
      .attr("class", "frame")
      .attr("x", room.left)
      .attr("y", room.top)
      .attr("width", right - room.left)
      .attr("height", height - room.bottom - room.top);
    if (zero) {
      this.svg.append("line").attr("class", "zero-rail").attr("stroke", "var(--line)").attr("x1", room.left).attr("x2", right).attr("y1", this.floor).attr("y2", this.floor);
      this.svg.append("text").attr("x", room.left - 8).attr("y", this.floor + CHART_GAP + 4).attr("text-anchor", "end").text("0");
    }
    this.svg
      .append("text")
      .attr("x", (room.left + right) / 2)
      .attr("y", height - 6)
      .attr("text-anchor", "middle")
      .text(this.xTitle);
    this.svg
      .append("text")
      .attr("transform", `translate(13 ${(room.top + height - room.bottom) / 2}) rotate(-90)`)
      .attr("text-anchor", "middle")
      .text(this.yTitle);
  }

  // Lines of whole exponents from the point where the worst series begins.
  guideLines(positive) {
    const first = d3.min(positive, (point) => point.x);
    const from = { x: first, y: d3.max(positive.filter((point) => point.x <= 1.5 * first), (point) => point.y) };
    const [x0, x1] = this.x.domain();
    const [y0, y1] = this.y.domain();
    const layer = this.svg.append("g");
    for (const exponent of this.guides) {
      const at = (x) => from.y * (x / from.x) ** exponent;
      const inverse = (y) => from.x * (y / from.y) ** (1 / exponent);
      const start = Math.max(x0, inverse(y1));
      const end = Math.min(x1, inverse(y0));
      if (!(end > start)) continue;
      layer
        .append("line")
        .attr("class", "guide")
        .attr("x1", this.x(start))
        .attr("y1", this.y(at(start)))
        .attr("x2", this.x(end))
        .attr("y2", this.y(at(end)));
      const bottom = at(end) <= y0 * 1.0001;
      layer
        .append("text")
        .attr("class", "guide-label")
        .attr("text-anchor", "end")
        .attr("x", this.x(end) - (bottom ? 6 : 4))
        .attr("y", this.y(at(end)) + (bottom ? -6 : 13))
        .text(`${this.guideName}${superscript(exponent).replace("-", "⁻")}`);
    }
  }

  targetLine() {
    if (this.target === null || !(this.target > 0)) return;
    const [low, high] = this.y.domain();
    if (this.target < low || this.target > high) return;
    rule(this.svg.append("g"), this.y(this.target), false, [this.room.left, this.width - this.room.right, 0, 0]).attr("class", "target");
  }

  oneSeries(one) {
    const layer = this.svg.append("g").attr("class", "series").attr("data-series", one.index);
    const colour = seriesColour(one.index);
    const drawn = one.points.filter(drawable);
    const line = d3.line(
      (point) => this.px(point),
      (point) => this.py(point),
    );
    const clip = (value) => Math.min(this.floor, this.y(Math.max(value, this.y.domain()[0])));
    // A line joins what can be measured: it breaks at exact zeros.
    for (const run of runs(drawn, (point) => point.y > 0)) {
      const banded = run.filter((point) => point.low !== null && point.high !== null);
      if (banded.length > 1) {
        const area = d3.area((point) => this.px(point), (point) => clip(point.low), (point) => clip(point.high));
        layer.append("path").attr("class", "band").style("fill", colour).attr("d", area(banded));
      }
      layer.append("path").attr("class", "line").style("stroke", colour).attr("stroke-dasharray", seriesDash(one.index)).attr("d", line(run));
    }
    for (const point of drawn) {
      const [x, y] = [this.px(point), this.py(point)];
      let whiskers = "";
      if (point.y > 0 && point.low !== null && point.high !== null) whiskers += `M${x},${clip(point.low)}V${clip(point.high)}`;
      if (point.left > 0 && point.right > 0) whiskers += `M${this.x(point.left)},${y}H${this.x(point.right)}`;
      if (whiskers) layer.append("path").attr("class", "whisker").style("stroke", colour).attr("d", whiskers);
      const marker = layer
        .append("path")
        .attr("class", point.hollow ? "point hollow" : "point")
        .attr("transform", `translate(${x} ${y})`)
        .attr("d", seriesMarker(one.index))
        .style("fill", colour);
      if (point.hollow) marker.style("stroke", colour);
    }
  }

  // Names at the ends of the lines, moved apart where they would touch.
  names() {
    const labels = this.series
      .map((one) => ({ one, last: one.points.filter(drawable).at(-1) }))
      .filter(({ last }) => last)
      .map(({ one, last }) => ({ one, y: this.py(last), x: this.px(last) }))
      .sort((a, b) => a.y - b.y);
    spread(labels, CHART_GAP, this.room.top + 4, this.height - this.room.bottom);
    const right = this.width - this.room.right;
    for (const { one, y } of labels) {
      const text = this.svg
        .append("text")
        .attr("class", "name series")
        .attr("data-series", one.index)
        .attr("x", right + 8)
        .attr("y", y + 4)
        .style("fill", seriesColour(one.index))
        .text(shortened(one.name, 20));
      text.append("title").text(one.name);
    }
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

function padded(values, share) {
  let [low, high] = d3.extent(values);
  if (!(high > low)) [low, high] = [low / 2, high * 2];
  const margin = (high / low) ** share;
  return [low / margin, high * margin];
}

// Powers of ten, thinned to fit; 2 and 5 between them where less than two decades are shown.
function logTicks([low, high], room) {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  const step = Math.max(1, Math.ceil((last - first + 1) / room));
  const decades = d3.range(first, last + 1).map((exponent) => 10 ** exponent);
  const within = (value) => value >= low && value <= high;
  if (decades.length < 3) {
    const steps = d3.range(first - 1, last + 1).flatMap((exponent) => [1, 2, 5].map((digit) => digit * 10 ** exponent));
    return { major: steps.filter(within), minor: [] };
  }
  const major = decades.filter((_, index) => index % step === 0);
  const minor =
    step > 1
      ? decades.filter((_, index) => index % step !== 0)
      : d3.range(first - 1, last + 1).flatMap((exponent) => d3.range(2, 10).map((digit) => digit * 10 ** exponent));
  return { major, minor: minor.filter(within) };
}

function tickText(value) {
  const exponent = Math.log10(value);
  return Math.abs(exponent - Math.round(exponent)) < 1e-9 ? power(Math.round(exponent)) : formatNumber(value, 1);
}

function rule(layer, at, vertical, [left, right, top, bottom]) {
  const line = layer.append("line");
  if (vertical) return line.attr("x1", at).attr("x2", at).attr("y1", top).attr("y2", bottom);
  return line.attr("x1", left).attr("x2", right).attr("y1", at).attr("y2", at);
}

function runs(list, belongs) {
  const found = [];
  let open = null;
  for (const item of list) {
    if (!belongs(item)) open = null;
    else if (open) open.push(item);
    else found.push((open = [item]));
  }
  return found;
}

function spread(labels, gap, top, bottom) {
  for (let index = 0, least = top; index < labels.length; index += 1) {
    labels[index].y = Math.max(labels[index].y, least);
    least = labels[index].y + gap;
  }
  for (let index = labels.length - 1, most = bottom; index >= 0; index -= 1) {
    labels[index].y = Math.min(labels[index].y, most);
    most = labels[index].y - gap;
  }
}

function shortened(text, length) {
  return text.length > length ? `${text.slice(0, length - 1)}…` : text;
}
