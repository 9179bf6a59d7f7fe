// Helpers for elements of the page, for numbers as text and for canvases.

const byId = (id) => document.getElementById(id);

/** Seconds as text, with as many digits as differences of `step` seconds need. */
function seconds(value, step = value / 1000) {
  const digits = step > 0 ? Math.max(0, Math.min(9, Math.ceil(-Math.log10(step)))) : 0;
  return `${value.toFixed(digits)} s`;
}

function bytes(count) {
  if (count < 1024) return `${count} B`;
  return count < 1048576 ? `${(count / 1024).toFixed(1)} KiB` : `${(count / 1048576).toFixed(1)} MiB`;
}

/** A colour of the style sheet. */
const colourOf = (name) => getComputedStyle(byId("viewer")).getPropertyValue(`--${name}`).trim();

/** Sizes a canvas to its place on the screen and clears it; returns its context and its size in CSS pixels. */
function fit(canvas) {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}

const count = (number, name) => `${number.toLocaleString("en")} ${name}${number === 1 ? "" : "s"}`;

/** 1, 2 or 5 times a power of ten, at least `value`. */
function roundStep(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= value);
}
