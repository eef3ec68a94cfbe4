// Opens the page as a visitor does, from a file, and compares what it shows with what the native
// program has computed. Usage: node check_web.mjs FOLDER CHROMIUM FIRST SECOND, two resolutions:
// FOLDER has the page, playwright-core, and native_FIRST and native_SECOND, the program's solution
// and form_factors.json of each. Exit 1 on a difference.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [folder, executablePath, first, second] = process.argv.slice(2);
const { chromium } = createRequire(resolve(folder, "index.js"))("playwright-core");
const address = pathToFileURL(resolve(folder, "hemicube.html")).href;
const timeout = 240000; // of a whole solution, on a busy machine

// Pixels of the picture of 600 x 600.
const onLeftWall = [75, 200];
const onRightWall = [536, 200];
const behind = [300, 230];
const onLamp = [300, 84];

const problems = [];
function check(isRight, what) {
  console.log(`${isRight ? "ok  " : "FAIL"} ${what}`);
  if (!isRight) problems.push(what);
}

const nativeHash = (resolution) =>
  JSON.parse(readFileSync(join(folder, `native_${resolution}`, "form_factors.json"))).result.hashes
    .form_factors;

/// Pixels of a canvas or of an image in a page, [row][column][4].
async function pixelsOf(page, source) {
  const text = await page.evaluate(async (url) => {
    let canvas = document.getElementById("picture");
    if (url !== null) {
      const image = new Image();
      image.src = url;
      await image.decode();
      canvas = new OffscreenCanvas(image.width, image.height);
      canvas.getContext("2d").drawImage(image, 0, 0);
    }
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const reader = new FileReader();
    reader.readAsDataURL(new Blob([data]));
    await new Promise((accept) => (reader.onload = accept));
    return reader.result.split(",")[1];
  }, source);
  return Buffer.from(text, "base64");
}

const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
const complaints = [];
page.on("console", (message) => {
  const isOurs = /willReadFrequently/.test(message.text()); // pixelsOf() reads often
  if (["error", "warning"].includes(message.type()) && !isOurs) complaints.push(message.text());
});
page.on("pageerror", (error) => complaints.push(error.message));
page.on("requestfailed", (request) => complaints.push(`not there: ${request.url()}`));
const requests = [];
page.on("request", (request) => requests.push(request.url()));

const state = () => page.evaluate(() => ({ ...document.body.dataset }));
const until = (condition) => page.waitForFunction(condition, null, { timeout, polling: 50 });
/// Until nothing will change any more.
const settled = () => until(() => document.body.dataset.idle === "true");
const shown = () => pixelsOf(page, null);
const text = (id) => page.locator(`#${id}`).textContent();
const at = (pixels, x, y) => [...pixels.subarray(4 * (600 * y + x), 4 * (600 * y + x) + 3)];
const mean = (pixels) => pixels.reduce((sum, value) => sum + value, 0) / pixels.length;
const changed = (a, b) => {
  let count = 0;
  for (let k = 0; k < a.length; k += 4)
    count += a[k] !== b[k] || a[k + 1] !== b[k + 1] || a[k + 2] !== b[k + 2] ? 1 : 0;
  return count / (a.length / 4);
};

// ---- The first solution, before the visitor's eyes.
await page.goto(address);
await until(() => Number(document.body.dataset.shots) >= 4);
const early = await shown();
const earlyState = await state();
check(
  earlyState.converged === "false",
  `light is seen to grow: a picture after ${earlyState.shots} shots`,
);
check((await text("hash")) === "when all rows are there", "no hash of F before all rows are there");
await settled();
const lit = await shown();
check(
  mean(lit) > mean(early) + 10,
  `it has grown: mean ${mean(early).toFixed(1)}, then ${mean(lit).toFixed(1)} of 255`,
);
check((await text("state")) === "done", "it comes to an end");
check(parseFloat(await text("unshot")) <= 0.1, `unshot light ${await text("unshot")}`);
check(
  (await text("hash")) === nativeHash(first),
  `F at ${first} is the native program's: ${await text("hash")}`,
);
check((await text("equal")) === "the same as the native program's", "the page says so");
const png = readFileSync(join(folder, `native_${first}`, "view.png")).toString("base64");
const native = await pixelsOf(page, `data:image/png;base64,${png}`);
check(
  native.length === lit.length && changed(native, lit) === 0,
  "the picture is the native view.png, every pixel",
);
const [red, green, back] = [at(lit, ...onLeftWall), at(lit, ...onRightWall), at(lit, ...behind)];
check(red[0] > 128 && red[0] > 2 * red[1], `the left wall is lit and red: ${red}`);
check(green[1] > 96 && green[1] > 1.2 * green[0], `the right wall is lit and green: ${green}`);
check(Math.min(...back) > 96, `the wall behind is bright: ${back}`);
await page.screenshot({ path: join(folder, "page.png") });
const figures = `${await text("speed")} hemicubes/s, ${await text("shots")} shots, ${await text("time")}`;

// ---- Walking around.
const box = await page.locator("#picture").boundingBox();
const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
async function drag(dx, dy) {
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps: 5 });
  await page.mouse.up();
  await settled();
}
await drag(60, 30);
const dragged = await shown();
check(
  changed(dragged, lit) > 0.2,
  `dragging turns the room: ${Math.round(100 * changed(dragged, lit))} % of the pixels change`,
);
check((await text("hash")) === nativeHash(first), "and leaves F");
await page.screenshot({ path: join(folder, "turned.png") });
await page.locator("#home").click();
await settled();
check(changed(await shown(), lit) === 0, "the button leads back to the same picture");
await page.mouse.move(x, y);
await page.mouse.wheel(0, 100);
await settled();
check(changed(await shown(), lit) > 0.2, "the wheel goes away from it");
await page.locator("#home").click();
await page.locator("#picture").focus();
await page.keyboard.press("ArrowLeft");
await settled();
check(changed(await shown(), lit) > 0.2, "arrow keys turn it");
await page.locator("#home").click();
await settled();

// ---- Other light on the same form factors.
async function slide(id, value) {
  await page.locator(`#${id}`).fill(String(value));
  await settled();
}
await slide("light", 200);
const brighter = await shown();
check(mean(brighter) > mean(lit) + 10, `twice the light is brighter: ${mean(brighter).toFixed(1)}`);
check((await text("hash")) === nativeHash(first), "and leaves F");
await slide("light", 100);
check(changed(await shown(), lit) === 0, "the light as it was makes the picture that was");
await page.locator("#reflectance").focus();
await page.keyboard.press("Home");
await settled();
const black = await shown();
check((await text("hash")) === nativeHash(first), "black surfaces leave F");
check(
  Math.max(...at(black, ...onLeftWall), ...at(black, ...onRightWall), ...at(black, ...behind)) ===
    0,
  "but are black",
);
check(Math.min(...at(black, ...onLamp)) === 255, "under a lamp that is not");
await slide("reflectance", 50);
const darker = mean(await shown());
check(
  darker < mean(lit) - 10 && darker > mean(black),
  `half the reflectance is darker: ${darker.toFixed(1)}`,
);
await slide("reflectance", 100);

// ---- Other form factors.
await page.locator("#resolution").focus();
await page.keyboard.press("ArrowLeft");
await until(() => document.body.dataset.complete === "false");
check(Number((await state()).rows) < 2400, "another resolution needs new rows");
await settled();
check((await state()).resolution === second, `the next resolution is ${second}`);
check(
  (await text("hash")) === nativeHash(second),
  `F at ${second} is the native program's: ${await text("hash")}`,
);
check(nativeHash(first) !== nativeHash(second), "and another one");
const coarser = await shown();

// ---- Again, and with a rest.
await page.locator("#again").click();
await until(
  () => document.body.dataset.converged === "false" && Number(document.body.dataset.shots) > 4,
);
await page.locator("#pause").click();
await settled();
const resting = await state();
await page.waitForTimeout(500);
check(
  (await state()).shots === resting.shots && (await text("state")) === "paused",
  `it rests after ${resting.shots} shots`,
);
check(
  resting.rows === (await page.locator("#progress").evaluate((bar) => String(bar.max))),
  "with rows kept",
);
check(mean(await shown()) < mean(coarser) - 10, "and less light");
await page.locator("#pause").click();
await settled();
check(changed(await shown(), coarser) === 0, "and goes on to the same picture");

check(complaints.length === 0, `no complaints in the console ${complaints.join("; ")}`);
check(
  requests.every((url) => url === address || /^(blob|data):/.test(url)),
  "nothing else was asked for",
);
const unlabelled = await page.evaluate(
  () => [...document.querySelectorAll("input")].filter((input) => input.labels.length === 0).length,
);
check(unlabelled === 0, "every slider has a label");
await page.close();

// ---- On a telephone.
const small = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };
const phone = await (await browser.newContext(small)).newPage();
const phoneIsIdle = () =>
  phone.waitForFunction(() => document.body.dataset.idle === "true", null, {
    timeout,
    polling: 50,
  });
await phone.goto(address);
await phoneIsIdle();
const width = await phone.evaluate(() => document.documentElement.scrollWidth);
check(
  width <= small.viewport.width,
  `nothing sticks out of ${small.viewport.width} pixels: ${width}`,
);
await phone.screenshot({ path: join(folder, "phone.png"), fullPage: true });
const hand = await phone.context().newCDPSession(phone);
/// Fingers at some places across the middle of the picture.
const touch = (type, ...places) =>
  hand.send("Input.dispatchTouchEvent", {
    type,
    touchPoints: places.map((x, id) => ({ x, y: 200, id })),
  });
async function strokes(...each) {
  const before = await pixelsOf(phone, null);
  await touch("touchStart", ...each[0]);
  for (const places of each.slice(1)) await touch("touchMove", ...places);
  await touch("touchEnd");
  await phoneIsIdle();
  return changed(await pixelsOf(phone, null), before);
}
check((await strokes([150], [200], [250])) > 0.2, "a finger turns the room");
await phone.locator("#home").click();
await phoneIsIdle();
check((await strokes([180, 210], [150, 240], [120, 270])) > 0.2, "two go nearer");
const nearer = await phone.evaluate(() => view);
check(nearer.distance < 0.7 && nearer.turn === 0, `and do not turn it: ${JSON.stringify(nearer)}`);

// ---- Where it cannot run.
async function wordsWhere(isSo) {
  const broken = await browser.newPage();
  await broken.addInitScript(isSo);
  await broken.goto(address);
  await broken
    .locator("#problem")
    .waitFor({ state: "visible", timeout: 20000 })
    .catch(() => {});
  return (await broken.locator("#problem").isVisible())
    ? broken.locator("#problem").textContent()
    : "";
}
const withoutSimd = await wordsWhere(() => {
  WebAssembly.compile = () => Promise.reject(new WebAssembly.CompileError("no SIMD"));
});
check(/SIMD/.test(withoutSimd), "a browser without SIMD is told so");
const withoutMemory = await wordsWhere(() => {
  const instantiate = (source) =>
    source.replace("core.page_scene_bytes(scene.length)", "core.page_scene_bytes(0xf0000000)");
  const Original = Blob;
  window.Blob = class extends Original {
    constructor(parts, options) {
      super(parts.map(instantiate), options);
    }
  };
});
check(/not enough memory/.test(withoutMemory), "and one without memory, too");

await browser.close();
console.log(figures);
for (const problem of problems) console.error(`check-web: ${problem}`);
process.exit(problems.length > 0 ? 1 : 0);
