// The worker: shoots light and draws. It makes one picture each time the page asks for the next one.
"use strict";

/// Samples along each side of a pixel: while things move, and once they stand still.
const quickSamples = 1;
const fineSamples = 3;
/// Longest time between two pictures, in ms, if there is more to compute.
const patience = 50;

let core = null; // what the module exports
let settings = null; // {reflectance, light, resolution}, as the page says
let changed = { resolution: true, light: true };
let orbit = { turn: 0, tilt: 0, distance: 1 };
let paused = false;
let drawn = null; // what the last picture shows, as a text
let secondsShooting, secondsOfRows, rowsMade;

function check(code) {
  if (code === 0) return;
  const bytes = new Uint8Array(core.memory.buffer, core.page_message());
  const text = new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
  throw new Error(text);
}

/// The module wants no more of a system than an empty environment.
const wasi_snapshot_preview1 = {
  environ_sizes_get(count, size) {
    const memory = new DataView(core.memory.buffer);
    memory.setUint32(count, 0, true);
    memory.setUint32(size, 0, true);
    return 0;
  },
  environ_get: () => 0,
  proc_exit() {
    throw new Error("the module has ended itself");
  },
};

async function open(module, scene) {
  core = (await WebAssembly.instantiate(module, { wasi_snapshot_preview1 })).exports;
  core._initialize();
  const at = core.page_scene_bytes(scene.length);
  if (at === 0) throw new Error("out of memory");
  new Uint8Array(core.memory.buffer).set(scene, at);
  check(core.page_open());
}

function begin() {
  if (changed.resolution) {
    check(core.page_set_resolution(settings.resolution));
    secondsOfRows = rowsMade = 0;
  }
  check(core.page_set_light(settings.reflectance, settings.light));
  changed = { resolution: false, light: false };
  secondsShooting = 0;
  drawn = null;
}

/// One step, timed where it makes a row.
function step(work) {
  const rows = core.page_rows();
  const start = performance.now();
  check(work());
  const seconds = (performance.now() - start) / 1000;
  if (core.page_rows() > rows) {
    rowsMade += core.page_rows() - rows;
    secondsOfRows += seconds;
  }
  return seconds;
}

const isConverged = () => core.page_is_converged() !== 0;
const isFilled = () => core.page_rows() === core.page_patches();

function compute() {
  const end = performance.now() + patience;
  if (!isConverged()) {
    // First every shot is shown, then more and more at once: light grows ever more slowly.
    const last = core.page_shots() + 1 + Math.floor(core.page_shots() / 16);
    while (!isConverged() && core.page_shots() < last && performance.now() < end)
      secondsShooting += step(core.page_shoot);
  } else {
    while (!isFilled() && performance.now() < end) step(core.page_fill);
  }
}

function draw(samples) {
  check(core.page_draw(orbit.turn, orbit.tilt, orbit.distance, samples));
  const width = core.page_width();
  const height = core.page_height();
  const pixels = new Uint8ClampedArray(core.memory.buffer, core.page_rgba(), 4 * width * height);
  return new ImageData(pixels.slice(), width, height);
}

/// Works until there is something to show; null if nothing will change without the visitor.
function next() {
  if (changed.resolution || changed.light) begin();
  if (!paused) compute();
  const isDone = isConverged();
  const isBusy = !paused && !(isDone && isFilled());
  const view = JSON.stringify([core.page_shots(), isDone, orbit]);
  const stands = drawn !== null && drawn.view === view;
  const samples = stands && (isDone || paused) ? fineSamples : quickSamples;
  const isNew = !stands || drawn.samples < samples;
  const image = isNew ? draw(samples) : null;
  if (isNew) drawn = { view, samples };
  return {
    image,
    isFine: drawn.samples === fineSamples,
    isIdle: !isBusy && drawn.samples === fineSamples,
    isConverged: isDone,
    shots: core.page_shots(),
    unshot: core.page_unshot(),
    rows: core.page_rows(),
    patches: core.page_patches(),
    hash: BigInt.asUintN(64, core.page_hash()).toString(16).padStart(16, "0"),
    resolution: settings.resolution,
    seconds: secondsShooting,
    speed: secondsOfRows > 0 ? rowsMade / secondsOfRows : 0,
  };
}

self.onmessage = async ({ data }) => {
  try {
    if (data.module) await open(data.module, data.scene);
    if (data.settings) {
      changed.resolution ||= settings === null || settings.resolution !== data.settings.resolution;
      changed.light = true;
      settings = data.settings;
    }
    if (data.orbit) orbit = data.orbit;
    if ("paused" in data) paused = data.paused;
    if (data.next) self.postMessage(next());
  } catch (error) {
    self.postMessage({ problem: String(error.message ?? error) });
  }
};
