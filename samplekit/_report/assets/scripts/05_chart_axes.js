// Axes of a log-log chart: range, ticks, grid, titles.

function drawAxes(chart, zero) {
  const { width, height, room } = chart;
  const right = width - room.right;
  for (const [scale, horizontal] of [
    [chart.x, true],
    [chart.y, false],
  ]) {
    const named = horizontal && chart.ticks;
    const ticks = named
      ? thinned(chart.ticks, scale, 44)
      : logTicks(scale.domain(), horizontal ? width / 70 : height / 42);
    const grid = chart.svg.append("g").attr("class", "grid");
    const minor = chart.svg.append("g").attr("class", "grid minor");
    for (const value of ticks.minor) rule(minor, scale(value), horizontal, [room.left, right, room.top, chart.floor]);
    for (const value of ticks.major) {
      rule(grid, scale(value), horizontal, [room.left, right, room.top, chart.floor]);
      const text = chart.svg.append("text").text(horizontal ? chart.formatX(value) : tickText(value));
      if (horizontal)
        text
          .attr("x", scale(value))
          .attr("y", height - room.bottom + 18)
          .attr("text-anchor", "middle");
      else
        text
          .attr("x", room.left - 8)
          .attr("y", scale(value) + 4)
          .attr("text-anchor", "end");
    }
  }
  chart.svg
    .append("rect")
    .attr("class", "frame")
    .attr("x", room.left)
    .attr("y", room.top)
    .attr("width", right - room.left)
    .attr("height", height - room.bottom - room.top);
  if (zero) {
    chart.svg
      .append("line")
      .attr("class", "zero-rail")
      .attr("stroke", "var(--line)")
      .attr("x1", room.left)
      .attr("x2", right)
      .attr("y1", chart.floor)
      .attr("y2", chart.floor);
    chart.svg
      .append("text")
      .attr("x", room.left - 8)
      .attr("y", chart.floor + CHART_GAP + 4)
      .attr("text-anchor", "end")
      .text("0");
  }
  chart.svg
    .append("text")
    .attr("x", (room.left + right) / 2)
    .attr("y", height - 6)
    .attr("text-anchor", "middle")
    .text(chart.xTitle);
  chart.svg
    .append("text")
    .attr("transform", `translate(13 ${(room.top + height - room.bottom) / 2}) rotate(-90)`)
    .attr("text-anchor", "middle")
    .text(chart.yTitle);
}

function rule(layer, at, vertical, [left, right, top, bottom]) {
  const line = layer.append("line");
  if (vertical) return line.attr("x1", at).attr("x2", at).attr("y1", top).attr("y2", bottom);
  return line.attr("x1", left).attr("x2", right).attr("y1", at).attr("y2", at);
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

// Those of the values that stand at least so many pixels apart.
function thinned(values, scale, gap) {
  const [low, high] = scale.domain();
  const major = [];
  for (const value of values) {
    const free = major.length === 0 || scale(value) - scale(major.at(-1)) >= gap;
    if (value >= low && value <= high && free) major.push(value);
  }
  return { major, minor: [] };
}

function tickText(value) {
  const exponent = Math.log10(value);
  return Math.abs(exponent - Math.round(exponent)) < 1e-9 ? power(Math.round(exponent)) : formatNumber(value, 1);
}
