// Which two images are compared, what is shown of them, and what is said about them.

class Comparison {
  constructor(section) {
    this.section = section;
    this.scene = section.querySelector("[name=pictured-scene]");
    this.a = section.querySelector("[name=a]");
    this.b = section.querySelector("[name=b]");
    this.count = section.querySelector("[name=count]");
    this.exposure = section.querySelector("[name=exposure]");
    this.readout = section.querySelector(".readout");
    this.sides = [];
    this.turn = 0;
    this.viewer = new Viewer(section, (pixel) => this.read(pixel));
    this.scene.addEventListener("input", () => this.fillSamplers());
    this.a.addEventListener("input", () => this.fillCounts());
    for (const input of section.querySelectorAll(
      "[name=b], [name=count], [name=equal], [name=show], [name=exposure], [name=layout]",
    )) {
      input.addEventListener("input", () => this.refresh());
    }
    for (const button of section.querySelectorAll("[data-zoom-to]")) {
      button.addEventListener("click", () => this.viewer.zoomTo(button.dataset.zoomTo));
    }
    onChange(() => this.equal === "time" && this.refresh());
    this.fillSamplers();
  }

  get pictures() {
    return DATA.pictures[Number(this.scene.value)];
  }

  get equal() {
    return this.checked("equal");
  }

  checked(name) {
    return this.section.querySelector(`[name=${name}]:checked`).value;
  }

  items(sampler) {
    return this.pictures.items.filter((item) => STUDY.rows[item.row].sampler === sampler);
  }

  fillSamplers() {
    const names = [...new Set(this.pictures.items.map((item) => STUDY.rows[item.row].sampler))];
    fill(this.a, names, names[0]);
    fill(this.b, names, names[Math.min(1, names.length - 1)]);
    this.fillCounts();
  }

  fillCounts() {
    const counts = this.items(this.a.value).map((item) => STUDY.rows[item.row].count);
    fill(this.count, counts, counts[Math.floor(counts.length / 2)], formatCount);
    this.refresh();
  }

  // The image of B that stands against A's: the nearest in samples, or in time.
  partner(item) {
    const byTime = this.equal === "time";
    const size = (other) => (byTime ? secondsOf(STUDY.rows[other.row]) : STUDY.rows[other.row].count);
    const wanted = size(item);
    const candidates = this.items(this.b.value).filter((other) => size(other) > 0);
    return d3.least(candidates, (other) => Math.abs(Math.log(size(other) / wanted))) ?? item;
  }

  async refresh() {
    const turn = (this.turn += 1);
    const { pictures } = this;
    const count = Number(this.count.value);
    const first = this.items(this.a.value).find((item) => STUDY.rows[item.row].count === count);
    const items = [first, this.partner(first)];
    const reference = await referencePixels(pictures.reference);
    const errors = await Promise.all(items.map((item) => errorPixels(item.pixels, item.step)));
    // Something else was chosen in the meantime.
    if (turn !== this.turn) return;
    this.reference = reference;
    this.sides = items.map((item, side) => ({ row: STUDY.rows[item.row], item, errors: errors[side] }));
    this.section.classList.toggle("wiping", this.checked("layout") === "wipe");
    const canvases = this.sides.map((side) => this.painted(side));
    this.words();
    this.viewer.show(canvases, [pictures.width, pictures.height], this.checked("layout") === "wipe");
    this.read(this.viewer.pixel);
    this.section.dataset.shown = items.map((item) => item.row).join(" ");
  }

  // The error with the strongest colour: three root mean squares of the noisier of the two, at exposure 0.
  get scale() {
    const rmse = Math.max(...this.sides.map((side) => side.item.rmse)) || 1;
    return (3 * rmse) / 2 ** Number(this.exposure.value);
  }

  painted({ errors }) {
    const { width, height } = this.pictures;
    const show = this.checked("show");
    if (show === "error") return painted(errors, width, height, errorColour(this.scale));
    const values = show === "reference" ? this.reference : this.reference.map((value, index) => value + errors[index]);
    return painted(values, width, height, greyColour(Number(this.exposure.value)));
  }

  words() {
    const show = this.checked("show");
    this.sides.forEach(({ row }, side) => {
      const time = measured(row) ? ` · ${formatSeconds(secondsOf(row), 2)}` : "";
      const text = show === "reference" ? "reference" : `${row.sampler} · ${formatCount(row.count)} samples${time}`;
      for (const tagline of this.section.querySelectorAll(`.tagline[data-side="${side}"]`)) tagline.textContent = text;
      this.section.querySelector(`.about[data-side="${side}"]`).textContent =
        `${row.sampler}: ${formatCount(row.count)} samples${time}, mean squared error of this image ${formatNumber(this.sides[side].item.mse)}`;
    });
    const exposure = Number(this.exposure.value);
    this.section.querySelector("#exposure-value").textContent =
      `${exposure > 0 ? "+" : exposure < 0 ? "−" : ""}${Math.abs(exposure)} stops`;
    const scale = this.section.querySelector(".scale");
    scale.hidden = show !== "error";
    if (show === "error") drawScale(scale, this.scale);
  }

  read(pixel) {
    if (!pixel || this.sides.length < 2) {
      this.readout.textContent = "Point at a pixel to read its values.";
      return;
    }
    const at = pixel.y * this.pictures.width + pixel.x;
    const [left, top] = this.pictures.window;
    const truth = this.reference[at];
    const parts = this.sides.map(
      ({ row, errors }) => `${row.sampler} ${formatNumber(truth + errors[at], 5)} (error ${formatSigned(errors[at])})`,
    );
    this.readout.textContent = `Pixel ${left + pixel.x}, ${top + pixel.y}: reference ${formatNumber(truth, 5)}; ${parts.join("; ")}`;
  }
}

function fill(select, values, otherwise, text = String) {
  const before = values.find((value) => String(value) === select.value);
  select.replaceChildren(...values.map((value) => new Option(text(value), String(value))));
  select.value = String(before ?? otherwise);
}

function drawScale(host, scale) {
  const canvas = host.querySelector("canvas");
  canvas.width = ERROR_COLOURS.length;
  canvas.height = 1;
  const context = canvas.getContext("2d");
  ERROR_COLOURS.forEach(([red, green, blue], x) => {
    context.fillStyle = `rgb(${red} ${green} ${blue})`;
    context.fillRect(x, 0, 1, 1);
  });
  host.querySelector(".low").textContent = formatNumber(-scale, 2);
  host.querySelector(".high").textContent = formatSigned(scale, 2);
}
