// What the page shows, and who wants to know when that changes.

const DATA = JSON.parse(document.getElementById("data").textContent);
const STUDY = DATA.study;
const LEAST_COST = -1;

const state = {
  hidden: new Set(),
  metric: "mse",
  blurred: false,
  // Nanoseconds for each sample, on top of what was measured.
  cost: STUDY.cost,
  // Error that is to be reached, for each scene.
  targets: new Map(Object.entries(STUDY.target)),
};

const listeners = [];

function onChange(listener) {
  listeners.push(listener);
}

function change(news) {
  Object.assign(state, news);
  for (const listener of listeners) listener();
}

function rowsOf(scene, sampler) {
  return STUDY.rows.filter((row) => row.scene === scene && row.sampler === sampler);
}

// Seconds of a trial as measured, with their interval, and with what a sample is said to cost.
function measured(row) {
  return row.times?.seconds ?? null;
}

function secondsOf(row, cost = state.cost) {
  const own = measured(row);
  return own && own.estimate + cost * 1e-9 * row.samples;
}

// Costs on a logarithmic slider, whose left end is none.
function costAt(position) {
  return position <= LEAST_COST ? 0 : 10 ** position;
}

function positionOf(cost) {
  return cost > 0 ? Math.max(LEAST_COST, Math.log10(cost)) : LEAST_COST;
}
