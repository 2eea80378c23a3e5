// What is drawn between the axes: guide lines, the target, and for each series a line, markers, intervals, a name.

const ARROW = 22;

// Lines of whole exponents from the point where the worst series begins.
function drawGuides(chart, positive) {
  const first = d3.min(positive, (point) => point.x);
  const from = {
    x: first,
    y: d3.max(
      positive.filter((point) => point.x <= 1.5 * first),
      (point) => point.y,
    ),
  };
  const [x0, x1] = chart.x.domain();
  const [y0, y1] = chart.y.domain();
  const layer = chart.svg.append("g");
  for (const exponent of chart.guides) {
    const at = (x) => from.y * (x / from.x) ** exponent;
    const inverse = (y) => from.x * (y / from.y) ** (1 / exponent);
    const start = Math.max(x0, inverse(y1));
    const end = Math.min(x1, inverse(y0));
    if (!(end > start)) continue;
    layer
      .append("line")
      .attr("class", "guide")
      .attr("x1", chart.x(start))
      .attr("y1", chart.y(at(start)))
      .attr("x2", chart.x(end))
      .attr("y2", chart.y(at(end)));
    const bottom = at(end) <= y0 * 1.0001;
    layer
      .append("text")
      .attr("class", "guide-label")
      .attr("text-anchor", "end")
      .attr("x", chart.x(end) - (bottom ? 6 : 4))
      .attr("y", Math.min(chart.y(at(end)) + (bottom ? -6 : 13), chart.floor - 6))
      .text(chart.guideName + superscript(exponent));
  }
}

function drawTarget(chart) {
  if (chart.target === null || !(chart.target > 0)) return;
  const [low, high] = chart.y.domain();
  if (chart.target < low || chart.target > high) return;
  rule(chart.svg.append("g"), chart.y(chart.target), false, [
    chart.room.left,
    chart.width - chart.room.right,
    0,
    0,
  ]).attr("class", "target");
}

function drawSeries(chart, one) {
  const layer = chart.svg.append("g").attr("class", "series").attr("data-series", one.index);
  const colour = seriesColour(one.index);
  const drawn = one.points.filter(drawable);
  const line = d3.line(
    (point) => chart.px(point),
    (point) => chart.py(point),
  );
  const clip = (value) => Math.min(chart.floor, chart.y(Math.max(value, chart.y.domain()[0])));
  // A line joins what can be measured: it breaks at exact zeros.
  for (const run of runs(drawn, (point) => point.y > 0)) {
    const banded = run.filter((point) => point.low > 0 && point.high !== null);
    if (banded.length > 1) {
      const area = d3.area(
        (point) => chart.px(point),
        (point) => clip(point.low),
        (point) => clip(point.high),
      );
      layer.append("path").attr("class", "band").style("fill", colour).attr("d", area(banded));
    }
    layer
      .append("path")
      .attr("class", "line")
      .style("stroke", colour)
      .attr("stroke-dasharray", seriesDash(one.index))
      .attr("d", line(run));
  }
  for (const point of drawn) {
    const [x, y] = [chart.px(point), chart.py(point)];
    let whiskers = "";
    if (point.y > 0 && point.low !== null && point.high !== null) {
      // Zero is infinitely far down: a whisker that reaches it ends soon, in an arrow.
      const down = point.low > 0 ? "" : "m-3,-4l3,4l3,-4";
      const end = point.low > 0 ? clip(point.low) : Math.min(chart.floor, y + ARROW);
      whiskers += `M${x},${clip(point.high)}V${end}${down}`;
    }
    if (point.left > 0 && point.right > 0) whiskers += `M${chart.x(point.left)},${y}H${chart.x(point.right)}`;
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

// Names at the ends of the lines, moved apart where they would touch.
function drawNames(chart) {
  const labels = chart.series
    .map((one) => ({ one, last: one.points.filter(drawable).at(-1) }))
    .filter(({ last }) => last)
    .map(({ one, last }) => ({ one, y: chart.py(last), x: chart.px(last) }))
    .sort((a, b) => a.y - b.y);
  spread(labels, CHART_GAP, chart.room.top + 4, chart.height - chart.room.bottom);
  const right = chart.width - chart.room.right;
  for (const { one, y } of labels) {
    const text = chart.svg
      .append("text")
      .attr("class", "name series")
      .attr("data-series", one.index)
      .attr("x", right + 8)
      .attr("y", y + 4)
      .style("fill", seriesColour(one.index))
      .text(shortened(one.name, LONGEST_NAME));
    text.append("title").text(one.name);
  }
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
