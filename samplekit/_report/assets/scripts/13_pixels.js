// Pixels that are embedded in the page: deflated byte planes, unpacked when first looked at.

const DECODED = new Map();

function decoded(id, unpack) {
  if (!DECODED.has(id)) DECODED.set(id, inflated(id).then(unpack));
  return DECODED.get(id);
}

// The pixels come last in the page: charts are there before them.
const ALL_READ = new Promise((resolve) => {
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", resolve, { once: true });
  else resolve();
});

async function inflated(id) {
  await ALL_READ;
  const text = atob(document.getElementById(id).textContent.trim());
  const bytes = Uint8Array.from(text, (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// float32, its four bytes in planes, the lowest first.
function referencePixels(id) {
  return decoded(id, (bytes) => {
    const count = bytes.length / 4;
    const words = new Uint32Array(count);
    for (let i = 0; i < count; i += 1) {
      words[i] = bytes[i] | (bytes[count + i] << 8) | (bytes[2 * count + i] << 16) | (bytes[3 * count + i] << 24);
    }
    return new Float32Array(words.buffer);
  });
}

// Whole multiples of a step: 0, -1, 1, -2, ... as 24 bits in three planes; the largest code is a pixel without a value.
function errorPixels(id, step) {
  return decoded(id, (bytes) => {
    const count = bytes.length / 3;
    const errors = new Float32Array(count);
    for (let i = 0; i < count; i += 1) {
      const code = bytes[i] | (bytes[count + i] << 8) | (bytes[2 * count + i] << 16);
      errors[i] = code === 0xffffff ? NaN : step * (code & 1 ? -(code + 1) / 2 : code / 2);
    }
    return errors;
  });
}

function srgbByte(linear) {
  const value = Math.min(1, Math.max(0, linear));
  return 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055) + 0.5;
}

// values: Float32Array; colour(value): [r, g, b]. Pixels without a value have a colour that none has.
function painted(values, width, height, colour) {
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext("2d");
  const image = context.createImageData(width, height);
  for (let i = 0; i < values.length; i += 1) {
    const [red, green, blue] = Number.isFinite(values[i]) ? colour(values[i]) : DATA.invalid_colour;
    image.data.set([red, green, blue, 255], 4 * i);
  }
  context.putImageData(image, 0, 0);
  return canvas;
}

function greyColour(exposure) {
  const gain = 2 ** exposure;
  return (value) => {
    const byte = srgbByte(gain * value);
    return [byte, byte, byte];
  };
}

const ERROR_COLOURS = DATA.error_colours
  .match(/.{6}/g)
  .map((hex) => [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)));

// Blue below zero, white at zero, red above; beyond the scale the colour of the end.
function errorColour(scale) {
  const middle = (ERROR_COLOURS.length - 1) / 2;
  return (value) => ERROR_COLOURS[Math.round(middle + middle * Math.min(1, Math.max(-1, value / scale)))];
}
