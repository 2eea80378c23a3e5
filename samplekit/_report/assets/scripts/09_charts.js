// The two charts of each scene, and what moves with them.

const METRICS = {
  mse: { title: "mean squared error", of: (row) => (state.blurred ? row.blurred_mse : row.mse) },
  variance: { title: "variance", of: (row) => row.variance },
  bias: { title: "|bias|", of: (row) => magnitude(row.bias) },
};

// A signed value has no logarithm: its size, with an interval that reaches zero where the value's sign is not known.
function magnitude({ estimate, low, high }) {
  if (estimate === null) return { estimate, low: null, high: null };
  if (low === null || high === null) return { estimate: Math.abs(estimate), low: null, high: null };
  const ends = [Math.abs(low), Math.abs(high)];
  return { estimate: Math.abs(estimate), low: low <= 0 && high >= 0 ? 0 : Math.min(...ends), high: Math.max(...ends) };
}

function metricTitle() {
  return METRICS[state.metric].title + (state.blurred ? ", blurred by 2 pixels" : "");
}

// A point of a chart for a row; null where the metric was not measured, or time was not.
function chartPoint(row, overTime) {
  const error = METRICS[state.metric].of(row);
  if (!error || error.estimate === null) return null;
  const own = measured(row);
  if (overTime && !own) return null;
  const added = overTime ? secondsOf(row) - own.estimate : 0;
  return {
    row,
    x: overTime ? own.estimate + added : row.count,
    left: overTime && own.low !== null ? own.low + added : null,
    right: overTime && own.high !== null ? own.high + added : null,
    y: error.estimate,
    low: error.low,
    high: error.high,
    hollow: !row.fitted,
  };
}

class SceneCharts {
  constructor(section) {
    this.scene = STUDY.scenes[Number(section.dataset.scene)];
    this.charts = [...section.querySelectorAll(".chart")].map((host) => this.chart(host, host.dataset.over === "time"));
    this.refresh();
    onChange(() => this.refresh());
  }

  chart(host, overTime) {
    const chart = new Chart(host, {
      label: `${this.scene}: error against ${overTime ? "time" : "samples"}`,
      xTitle: overTime ? "seconds of processor time for a trial" : "samples of a pixel",
      yTitle: "",
      formatX: overTime ? (value) => formatSeconds(value, 1) : formatCount,
      ticks: overTime ? null : countsOf(this.scene),
      guides: [-1, -1.5, -2, -3],
      guideName: overTime ? "t" : "N",
      onFocus: (point, from) => this.focus(point, from),
    });
    chart.overTime = overTime;
    return chart;
  }

  refresh() {
    for (const chart of this.charts) {
      const series = STUDY.samplers
        .map((name, index) => ({ index, name }))
        .filter(({ name }) => !state.hidden.has(name))
        .map((one) => ({
          ...one,
          points: rowsOf(this.scene, one.name)
            .map((row) => chartPoint(row, chart.overTime))
            .filter((point) => point !== null),
        }))
        .filter((one) => one.points.length > 0);
      const squared = state.metric === "mse" && !state.blurred;
      chart.update(series, { yTitle: metricTitle(), target: squared ? (state.targets.get(this.scene) ?? null) : null });
    }
  }

  focus(point, from) {
    for (const chart of this.charts) {
      chart.focus(point && (chart.points.find((other) => other.row === point.row) ?? null));
    }
    if (point) showTooltip(rowFacts(point), from.place(point));
    else hideTooltip();
  }
}

function countsOf(scene) {
  const counts = STUDY.rows.filter((row) => row.scene === scene).map((row) => row.count);
  return d3.sort(new Set(STUDY.counts.every((count) => counts.includes(count)) ? STUDY.counts : counts));
}

function rowFacts(point) {
  const { row } = point;
  const own = measured(row);
  const facts = [
    ["samples", formatCount(row.count) + (row.replaced ? ` (for ${row.asked.map(formatCount).join(", ")})` : "")],
    [METRICS[state.metric].title, formatNumber(point.y)],
    ["95 %", formatInterval(point.low, point.high)],
  ];
  if (own) {
    const added = secondsOf(row) - own.estimate;
    facts.push(["time", formatSeconds(secondsOf(row))]);
    if (own.low !== null) facts.push(["95 %", `${formatSeconds(own.low + added)} … ${formatSeconds(own.high + added)}`]);
    if (added > 0) facts.push(["as measured", formatSeconds(own.estimate)]);
  }
  facts.push(["trials", formatCount(row.trials)]);
  const remarks = [row.replaced, row.left_out && `not in the fit: ${row.left_out}`, ...row.notes];
  if (row.invalid_pixels) remarks.unshift(`${formatCount(row.invalid_pixels)} pixels without a finite value, left out`);
  return { title: row.sampler, facts, remarks: remarks.filter(Boolean) };
}
