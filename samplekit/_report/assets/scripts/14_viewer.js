// Two pictures of one size under one zoom: side by side, or the second wiped over the first.

const LARGEST_PIXEL = 48;
const GRAB = 18;

class Viewer {
  // onPixel({x, y} or null): the pixel under the pointer.
  constructor(section, onPixel) {
    this.onPixel = onPixel;
    this.panes = [...section.querySelectorAll(".view")].map((host) => ({ host, canvas: host.querySelector("canvas") }));
    this.divider = section.querySelector(".divider");
    this.slider = section.querySelector("[name=wipe]");
    this.pictures = [];
    this.size = [1, 1];
    this.wiping = false;
    this.pixel = null;
    this.transform = d3.zoomIdentity;
    this.zoom = d3
      .zoom()
      .filter((event) => this.zooms(event))
      .on("zoom", (event) => this.zoomed(event));
    for (const pane of this.panes) this.listen(pane);
    this.slider.addEventListener("input", () => this.draw());
    new ResizeObserver(() => this.fit()).observe(section);
  }

  listen({ canvas }) {
    d3.select(canvas).call(this.zoom).on("dblclick.zoom", null);
    canvas.addEventListener("pointermove", (event) => this.pointed(event));
    canvas.addEventListener("pointerdown", (event) => this.pointed(event));
    canvas.addEventListener("pointerleave", () => this.point(null));
    canvas.addEventListener("keydown", (event) => this.keyed(event));
    const wipe = d3
      .drag()
      .filter((event) => this.grabs(event))
      .on("drag", (event) => {
        this.slider.value = (100 * event.x) / this.panes[0].canvas.clientWidth;
        this.draw();
      });
    d3.select(canvas).call(wipe);
  }

  // pictures: two canvases of the size [width, height]; another size begins with the whole picture.
  show(pictures, size, wiping) {
    const other = String(size) !== String(this.size);
    Object.assign(this, { pictures, size, wiping });
    this.panes[1].host.hidden = wiping;
    this.divider.hidden = !wiping;
    if (other) this.transform = d3.zoomIdentity;
    this.fit();
  }

  // CSS pixels of one pixel of the picture where all of it is seen.
  get unit() {
    return this.panes[0].canvas.clientWidth / this.size[0];
  }

  fit() {
    const [width, height] = this.size;
    for (const { canvas } of this.panes) {
      canvas.style.aspectRatio = `${width} / ${height}`;
      const ratio = window.devicePixelRatio || 1;
      canvas.width = Math.round(canvas.clientWidth * ratio);
      canvas.height = Math.round(canvas.clientHeight * ratio);
    }
    const { clientWidth, clientHeight } = this.panes[0].canvas;
    if (clientWidth === 0) return;
    const extent = [
      [0, 0],
      [clientWidth, clientHeight],
    ];
    this.zoom
      .extent(extent)
      .translateExtent(extent)
      .scaleExtent([1, Math.max(2, LARGEST_PIXEL / this.unit)]);
    this.share(this.transform);
  }

  // Both canvases have the same zoom, whichever was moved.
  share(transform) {
    this.transform = transform;
    for (const { canvas, host } of this.panes) {
      canvas.__zoom = transform;
      // A finger moves the page while all of the picture is seen, and the picture when it is enlarged.
      canvas.style.touchAction = transform.k > 1 ? "none" : "pan-y";
      host.dataset.zoom = transform.k.toFixed(3);
    }
    this.draw();
  }

  zoomed(event) {
    this.share(event.transform);
  }

  // A wheel turns the page unless the picture was clicked or Ctrl is held.
  zooms(event) {
    if (event.type === "wheel") return event.ctrlKey || event.metaKey || document.activeElement === event.currentTarget;
    if (event.touches?.length === 1) return this.transform.k > 1 && !this.grabs(event);
    return !event.button && !this.grabs(event);
  }

  grabs(event) {
    if (!this.wiping) return false;
    const [x] = d3.pointer(event.touches?.[0] ?? event, this.panes[0].canvas);
    return Math.abs(x - this.edge()) < GRAB;
  }

  edge() {
    return (this.panes[0].canvas.clientWidth * Number(this.slider.value)) / 100;
  }

  // how: "fit", or the CSS pixels that a pixel of the picture shall have.
  zoomTo(how) {
    const { canvas } = this.panes[0];
    if (how === "fit") this.share(d3.zoomIdentity);
    else d3.select(canvas).call(this.zoom.scaleTo, Number(how) / this.unit);
  }

  keyed(event) {
    const selection = d3.select(event.currentTarget);
    const step = 40 / this.transform.k;
    const moves = { ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    if (moves[event.key]) selection.call(this.zoom.translateBy, ...moves[event.key]);
    else if (event.key === "+" || event.key === "=") selection.call(this.zoom.scaleBy, 1.5);
    else if (event.key === "-") selection.call(this.zoom.scaleBy, 1 / 1.5);
    else if (event.key === "0") this.share(d3.zoomIdentity);
    else return;
    event.preventDefault();
  }

  pointed(event) {
    const canvas = event.currentTarget;
    const [x, y] = this.transform.invert(d3.pointer(event, canvas));
    const pixel = { x: Math.floor(x / this.unit), y: Math.floor(y / this.unit) };
    const inside = pixel.x >= 0 && pixel.y >= 0 && pixel.x < this.size[0] && pixel.y < this.size[1];
    canvas.style.cursor = this.grabs(event) ? "ew-resize" : "crosshair";
    this.point(inside ? pixel : null);
  }

  point(pixel) {
    this.pixel = pixel;
    this.onPixel(pixel);
    this.draw();
  }

  draw() {
    if (this.pictures.length < 2) return;
    const [first, second] = this.panes;
    this.paint(first.canvas, this.pictures[0]);
    if (!this.wiping) {
      this.paint(second.canvas, this.pictures[1]);
      return;
    }
    const edge = this.edge();
    this.divider.style.left = `${edge - 1}px`;
    this.paint(first.canvas, this.pictures[1], edge);
  }

  // from: CSS pixels from the left at which the picture begins to cover what is there.
  paint(canvas, picture, from = 0) {
    const context = canvas.getContext("2d");
    const ratio = canvas.width / canvas.clientWidth;
    const { k, x, y } = this.transform;
    const side = k * this.unit;
    context.save();
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.beginPath();
    context.rect(from, 0, canvas.clientWidth - from, canvas.clientHeight);
    context.clip();
    context.clearRect(from, 0, canvas.clientWidth - from, canvas.clientHeight);
    // Nothing between pixels is made up; only what is smaller than the screen's pixels is averaged.
    context.imageSmoothingEnabled = side * ratio < 1;
    context.drawImage(picture, x, y, this.size[0] * side, this.size[1] * side);
    if (this.pixel && side >= 4) {
      for (const [colour, inset] of [
        ["#000", 0],
        ["#fff", 1],
      ]) {
        context.strokeStyle = colour;
        const [left, top] = [x + this.pixel.x * side, y + this.pixel.y * side];
        context.strokeRect(left - inset, top - inset, side + 2 * inset, side + 2 * inset);
      }
    }
    context.restore();
  }
}
