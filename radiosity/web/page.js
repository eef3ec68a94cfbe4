// The page: its controls, and what it shows of the worker's work.
"use strict";

const element = (id) => document.getElementById(id);
const canvas = element("picture");
const context = canvas.getContext("2d");
const facts = JSON.parse(element("facts").textContent);
const resolutions = Object.keys(facts.hashes).map(Number);
const fullTurn = 3600; // tenths of a degree
const steepest = 850;

const state = document.body.dataset; // for tests

function fail(text) {
  element("problem").textContent = text;
  element("problem").hidden = false;
  element("state").textContent = "stopped";
}

function bytesOf(id) {
  return Uint8Array.from(atob(element(id).textContent), (digit) => digit.charCodeAt(0));
}

/// ---- Talking to the worker: one question at a time, so that it never works ahead of the eye.

let worker = null;
let isAsking = false;
let news = {}; // what the worker has not been told

function tell(more) {
  Object.assign(news, more);
  state.idle = false;
  ask();
}

function ask() {
  if (worker === null || isAsking) return;
  isAsking = true;
  worker.postMessage({ ...news, next: true });
  news = {};
}

function hear({ data }) {
  if (data.problem) {
    const isMemory = /memory/.test(data.problem);
    return fail(
      isMemory
        ? `There is not enough memory for this (${data.problem}). Reload the page, and choose a lower resolution.`
        : `The computation has stopped: ${data.problem}. Reload the page to begin anew.`,
    );
  }
  requestAnimationFrame(() => {
    show(data);
    isAsking = false;
    if (!data.isIdle || Object.keys(news).length > 0) ask();
  });
}

async function start() {
  let module;
  try {
    module = await WebAssembly.compile(bytesOf("module"));
  } catch {
    return fail(
      "This browser does not run WebAssembly with SIMD, which the page is made of. Any Chrome, Edge or Firefox of 2021 or later does, and Safari from 16.4 on.",
    );
  }
  try {
    worker = new Worker(
      URL.createObjectURL(new Blob([element("worker").textContent], { type: "text/javascript" })),
    );
  } catch (error) {
    return fail(`This browser does not let the page compute in the background: ${error.message}.`);
  }
  worker.onmessage = hear;
  worker.onerror = (event) => fail(`The computation has stopped: ${event.message}.`);
  tell({ module, scene: bytesOf("scene"), settings: settings(), orbit });
}

/// ---- What is seen.

function show(data) {
  if (data.image) {
    if (canvas.width !== data.image.width) canvas.width = data.image.width;
    if (canvas.height !== data.image.height) canvas.height = data.image.height;
    context.putImageData(data.image, 0, 0);
  }
  const isComplete = data.rows === data.patches;
  const expected = facts.hashes[data.resolution];
  element("state").textContent = isPaused
    ? "paused"
    : !data.isConverged
      ? "shooting light"
      : isComplete
        ? "done"
        : "light done; the rows that no shot needed";
  element("shots").textContent = data.shots.toLocaleString("en");
  element("unshot").textContent = `${(100 * data.unshot).toFixed(data.unshot < 0.1 ? 2 : 1)} %`;
  element("time").textContent = `${data.seconds.toFixed(1)} s`;
  if (data.speed > 0) element("speed").textContent = Math.round(data.speed).toLocaleString("en");
  element("rows").textContent =
    `${data.rows.toLocaleString("en")} of ${data.patches.toLocaleString("en")}`;
  element("progress").max = data.patches;
  element("progress").value = data.rows;
  element("hash").textContent = isComplete ? data.hash : "when all rows are there";
  const isEqual = data.hash === expected;
  element("equal").textContent = !isComplete
    ? ""
    : isEqual
      ? "the same as the native program's"
      : `not the native program's, ${expected}`;
  element("equal").className = isComplete ? (isEqual ? "yes" : "no") : "";
  Object.assign(state, {
    resolution: data.resolution,
    converged: data.isConverged,
    complete: isComplete,
    fine: data.isFine,
    shots: data.shots,
    rows: data.rows,
    idle: data.isIdle && Object.keys(news).length === 0,
  });
}

/// ---- Controls.

let isPaused = false;

function settings() {
  const resolution = resolutions[element("resolution").valueAsNumber];
  const reflectance = element("reflectance").valueAsNumber;
  const light = element("light").valueAsNumber;
  const texts = { reflectance: `${reflectance} %`, light: `${light} %`, resolution };
  for (const [name, text] of Object.entries(texts)) {
    document.querySelector(`output[for=${name}]`).textContent = text;
    element(name).setAttribute("aria-valuetext", text);
  }
  return { resolution, reflectance: reflectance / 100, light: light / 100 };
}

function setPaused(value) {
  isPaused = value;
  element("pause").textContent = value ? "Go on" : "Pause";
  element("pause").setAttribute("aria-pressed", String(value));
  tell({ paused: value });
}

element("resolution").max = resolutions.length - 1;
element("resolution").value = resolutions.indexOf(facts.first);
for (const name of ["reflectance", "light", "resolution"])
  element(name).addEventListener("input", () => tell({ settings: settings() }));
element("again").addEventListener("click", () => {
  tell({ settings: settings() });
  setPaused(false);
});
element("pause").addEventListener("click", () => setPaused(!isPaused));

let orbit = { turn: 0, tilt: 0, distance: 1 };
const view = { turn: 0, tilt: 0, distance: 1 }; // before rounding and wrapping

function move(turn, tilt, distance = 1) {
  view.turn -= turn;
  view.tilt = Math.min(Math.max(view.tilt + tilt, -steepest), steepest);
  view.distance = Math.min(Math.max(view.distance * distance, 0.3), 3);
  const wrap = (angle) => ((Math.round(angle) % fullTurn) + fullTurn) % fullTurn;
  orbit = { turn: wrap(view.turn), tilt: wrap(view.tilt), distance: view.distance };
  tell({ orbit });
}

element("home").addEventListener("click", () => {
  Object.assign(view, { turn: 0, tilt: 0, distance: 1 });
  move(0, 0);
});

const pointers = new Map(); // that are down, by their number

/// How far two fingers are apart.
function spread() {
  const [a, b] = [...pointers.values()];
  return Math.hypot(a.x - b.x, a.y - b.y);
}

canvas.addEventListener("pointerdown", (event) => {
  canvas.setPointerCapture(event.pointerId);
  pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
});
canvas.addEventListener("pointermove", (event) => {
  const last = pointers.get(event.pointerId);
  if (last === undefined) return;
  const before = pointers.size === 2 ? spread() : 0;
  const here = { x: event.clientX, y: event.clientY };
  pointers.set(event.pointerId, here);
  const perPixel = 1800 / canvas.clientWidth; // across the picture: half a turn
  if (pointers.size === 2) move(0, 0, before / Math.max(spread(), 1));
  else move(perPixel * (here.x - last.x), perPixel * (here.y - last.y));
});
for (const name of ["pointerup", "pointercancel"])
  canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
canvas.addEventListener(
  "wheel",
  (event) => {
    event.preventDefault();
    move(0, 0, Math.exp(Math.min(Math.max(event.deltaY, -100), 100) / 700));
  },
  { passive: false },
);
canvas.addEventListener("keydown", (event) => {
  const step = 50;
  const moves = {
    ArrowLeft: [-step, 0],
    ArrowRight: [step, 0],
    ArrowUp: [0, -step],
    ArrowDown: [0, step],
    "+": [0, 0, 0.9],
    "-": [0, 0, 1 / 0.9],
  };
  if (!(event.key in moves)) return;
  event.preventDefault();
  move(...moves[event.key]);
});

settings();
start();
