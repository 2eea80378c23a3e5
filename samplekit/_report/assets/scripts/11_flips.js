// For each cost of a sample the samplers that may reach the target first: a strip under the charts, coloured by winner,
// and grey where the intervals do not tell.

const STRIP = { height: 64, top: 6, bar: 30 };
const COSTS = [LEAST_COST, 6];
const COST_STEP = 0.01;

class Flips {
  constructor(host) {
    this.scene = STUDY.scenes[Number(host.dataset.scene)];
    this.strip = host.querySelector(".strip");
    this.sentence = host.querySelector(".sentence");
    this.slider = host.querySelector("input");
    this.output = host.querySelector("output");
    const errors = STUDY.rows
      .filter((row) => row.scene === this.scene && row.mse.estimate > 0)
      .map((row) => Math.log10(row.mse.estimate));
    [this.slider.min, this.slider.max] = d3.extent(errors);
    this.slider.addEventListener("input", () => {
      change({ targets: new Map(state.targets).set(this.scene, 10 ** Number(this.slider.value)) });
    });
    this.svg = d3.select(this.strip).append("svg").attr("role", "img");
    this.svg.on("click", (event) => {
      const position = this.x.invert(d3.pointer(event)[0]);
      change({ cost: costAt(Math.max(LEAST_COST, Math.min(COSTS[1], position))) });
    });
    drawnToFit(this.strip, 700, (width) => this.draw(width));
    onChange(() => this.draw());
  }

  found() {
    const target = state.targets.get(this.scene);
    const needs = STUDY.samplers
      .filter((name) => !state.hidden.has(name))
      .map((name) => ({ name, rows: rowsOf(this.scene, name).filter((row) => measured(row)?.estimate > 0) }))
      .filter(({ rows }) => rows.length)
      .map(({ name, rows }) => ({ name, ...needed(rows, target) }));
    const costs = d3.range(LEAST_COST, COSTS[1], COST_STEP).map((position) => costAt(position) * 1e-9);
    return winners(needs, costs);
  }

  draw(width = this.width) {
    if (!width) return;
    this.width = width;
    const target = state.targets.get(this.scene);
    this.slider.value = Math.log10(target);
    this.output.textContent = formatNumber(target);
    this.x = d3.scaleLinear(COSTS, [1, width - 1]);
    this.svg.attr("viewBox", `0 0 ${width} ${STRIP.height}`).selectAll("*").remove();
    const found = this.found();
    this.segments(found);
    for (const position of d3.range(0, COSTS[1] + 1, width < 480 ? 2 : 1)) {
      this.svg
        .append("text")
        .attr("x", this.x(position))
        .attr("y", STRIP.height - 8)
        .attr("text-anchor", position === COSTS[1] ? "end" : "middle")
        .text(formatSeconds(10 ** (position - 9), 1));
    }
    this.svg
      .append("text")
      .attr("x", 0)
      .attr("y", STRIP.height - 8)
      .text("0");
    const now = this.x(Math.min(COSTS[1], positionOf(state.cost)));
    this.svg
      .append("line")
      .attr("class", "now")
      .attr("x1", now)
      .attr("x2", now)
      .attr("y1", 0)
      .attr("y2", STRIP.top + STRIP.bar + 6);
    this.sentence.textContent = this.words(found, target);
    this.svg.attr("aria-label", this.sentence.textContent);
  }

  segments(found) {
    found.forEach(({ names, from }, at) => {
      const left = this.x(positionOf(from * 1e9));
      const right = at + 1 < found.length ? this.x(positionOf(found[at + 1].from * 1e9)) : this.x(COSTS[1]);
      if (right <= left) return;
      const name = listed(names);
      const group = this.svg.append("g").attr("data-sampler", name);
      group
        .append("rect")
        .attr("class", names.length > 1 ? "untold" : null)
        .attr("x", left)
        .attr("y", STRIP.top)
        .attr("width", right - left)
        .attr("height", STRIP.bar)
        .style("fill", names.length > 1 ? null : seriesColour(STUDY.samplers.indexOf(name)));
      group.append("title").text(name);
      if (right - left > 40) {
        group
          .append("text")
          .attr("class", "winner")
          .attr("x", (left + right) / 2)
          .attr("y", STRIP.top + STRIP.bar / 2 + 4)
          .attr("text-anchor", "middle")
          .text(shortened(name, Math.floor((right - left) / 8)));
      }
    });
  }

  words(found, target) {
    if (found.length === 0)
      return `No sampler that is switched on certainly reaches a mean squared error of ${formatNumber(target)}.`;
    const [first, ...others] = found.map(({ names, from }) => [listed(names), formatSeconds(from, 2)]);
    const lead = `To a mean squared error of ${formatNumber(target)} the fastest is ${first[0]}`;
    const untold = found.some(({ names }) => names.length > 1) ? " Where several are named, the intervals do not tell." : "";
    if (others.length === 0) return `${lead}, whatever a sample costs.${untold}`;
    const rest = others.map(([name, from]) => `from ${from} a sample on ${name}`);
    return `${lead} where samples cost nothing more; ${rest.join("; ")}.${untold}`;
  }
}

function listed(names) {
  return names.length > 1 ? `${names.slice(0, -1).join(", ")} or ${names.at(-1)}` : names[0];
}
