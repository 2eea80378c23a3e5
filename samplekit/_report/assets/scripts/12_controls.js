// Legend, metric, cost of a sample, light and dark.

function svgSwatch(index) {
  const svg = d3.create("svg").attr("class", "swatch").attr("viewBox", "-8 -8 16 16").attr("aria-hidden", "true");
  svg
    .append("line")
    .attr("x1", -8)
    .attr("x2", 8)
    .attr("stroke-width", 2)
    .attr("stroke-dasharray", seriesDash(index))
    .style("stroke", seriesColour(index));
  svg.append("path").attr("d", seriesMarker(index, 64)).style("fill", seriesColour(index));
  return svg.node();
}

function buildLegend() {
  const legend = document.getElementById("legend");
  STUDY.samplers.forEach((name, index) => {
    const button = document.createElement("button");
    button.type = "button";
    button.dataset.sampler = name;
    button.append(svgSwatch(index), name);
    button.addEventListener("click", () => {
      const hidden = new Set(state.hidden);
      if (!hidden.delete(name)) hidden.add(name);
      change({ hidden });
    });
    // Twice on a name: this one alone, or all again.
    button.addEventListener("dblclick", () => {
      const others = STUDY.samplers.filter((other) => other !== name);
      const alone = others.every((other) => state.hidden.has(other));
      change({ hidden: new Set(alone ? [] : others) });
    });
    legend.append(button);
  });
  const show = () => {
    for (const button of legend.children)
      button.setAttribute("aria-pressed", String(!state.hidden.has(button.dataset.sampler)));
  };
  onChange(show);
  show();
}

function buildMetric() {
  const blurred = document.querySelector("[name=blur][value=blurred]");
  const raw = document.querySelector("[name=blur][value=raw]");
  const possible = STUDY.rows.some((row) => row.blurred_mse !== null);
  const read = () => {
    const metric = document.querySelector("[name=metric]:checked").value;
    blurred.disabled = !possible || metric !== "mse";
    if (blurred.disabled) raw.checked = true;
    change({ metric, blurred: blurred.checked });
  };
  for (const input of document.querySelectorAll("[name=metric], [name=blur]")) input.addEventListener("change", read);
  read();
}

function buildCost() {
  const slider = document.getElementById("cost");
  const output = document.getElementById("cost-value");
  if (!slider) return;
  slider.addEventListener("input", () => change({ cost: costAt(Number(slider.value)) }));
  const show = () => {
    slider.value = positionOf(state.cost);
    output.textContent = state.cost > 0 ? formatSeconds(state.cost * 1e-9, 2) : "none";
    slider.setAttribute("aria-valuetext", output.textContent);
  };
  onChange(show);
  show();
}

function buildTheme() {
  const button = document.getElementById("theme");
  const dark = () => {
    const chosen = document.documentElement.dataset.theme;
    return chosen ? chosen === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
  };
  const show = () => (button.textContent = dark() ? "Light" : "Dark");
  button.addEventListener("click", () => {
    document.documentElement.dataset.theme = dark() ? "light" : "dark";
    show();
  });
  show();
}
