// Shows solution.glb in a browser and compares what it draws with what the file's colours say, and
// with view.png. Usage: node check_glb.mjs SOLUTION_DIR PACKAGES_DIR CHROMIUM; exit 1 on a
// difference.

import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { extname, join, normalize, resolve } from "node:path";
import { colourAt, readGlb } from "./glb.mjs";

const [solution, packages, chromium] = process.argv.slice(2);
const secondsToWait = 120;

const kinds = {
  ".html": "text/html",
  ".js": "text/javascript",
  ".png": "image/png",
  ".glb": "model/gltf-binary",
};
const folders = { three: join(packages, "node_modules/three"), solution };

/// Serves the page, three.js and the solution until the page has posted its result.
function drawInBrowser() {
  return new Promise((accept, reject) => {
    const profile = mkdtempSync(join(tmpdir(), "check_glb_"));
    let browser = null;
    const server = createServer((request, response) => {
      if (request.method === "POST") {
        const parts = [];
        request.on("data", (part) => parts.push(part));
        request.on("end", () => {
          response.end();
          end(accept, JSON.parse(Buffer.concat(parts).toString()));
        });
        return;
      }
      const [, folder, ...rest] = new URL(request.url, "http://localhost").pathname.split("/");
      const file =
        folder === ""
          ? new URL("page.html", import.meta.url)
          : folder in folders && join(folders[folder], normalize("/" + rest.join("/")));
      try {
        const bytes = readFileSync(file);
        response.setHeader("Content-Type", kinds[extname(String(file))] ?? "text/plain");
        response.end(bytes);
      } catch {
        response.writeHead(404).end();
      }
    });
    const timer = setTimeout(
      () => end(reject, new Error(`the browser has drawn nothing in ${secondsToWait} s`)),
      1000 * secondsToWait,
    );
    function end(settle, value) {
      clearTimeout(timer);
      server.close();
      server.closeAllConnections();
      const clean = () => {
        rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
        settle(value);
      };
      if (browser === null || browser.exitCode !== null) return clean();
      browser.removeAllListeners("exit");
      browser.once("exit", clean);
      browser.kill();
    }
    server.listen(0, "127.0.0.1", () => {
      const flags = ["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run"];
      const gl = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
      const url = `http://127.0.0.1:${server.address().port}/`;
      browser = spawn(chromium, [...flags, ...gl, `--user-data-dir=${profile}`, url], {
        stdio: "ignore",
      });
      browser.once("error", (error) => end(reject, error));
      browser.once("exit", (code) =>
        end(reject, new Error(`${chromium} ended with ${code} and has drawn nothing`)),
      );
    });
  });
}

const display = (linear) => {
  const cut = Math.min(Math.max(linear, 0), 1);
  return 255 * (cut <= 0.0031308 ? 12.92 * cut : 1.055 * cut ** (1 / 2.4) - 0.055);
};
const difference = (a, b) => Math.max(...a.map((value, k) => Math.abs(value - b[k])));

/// What the file's colours say at a pixel and just around it; null at an edge, where one pixel says
/// little.
function expectedAt(glb, x, y, { width, height }) {
  const at = (dx, dy) => colourAt(glb, (x + 0.5 + dx) / width, (y + 0.5 + dy) / height);
  const around = [at(0, 0), at(1, 1), at(1, -1), at(-1, 1), at(-1, -1)];
  if (around.includes(null)) return null;
  const shown = around.map((colour) => colour.map(display));
  return shown.every((each) => difference(each, shown[0]) < 8) ? shown[0] : null;
}

function compare(glb, result) {
  const { width, height } = result;
  const drawn = Buffer.from(result.drawn, "base64");
  const picture = Buffer.from(result.picture, "base64");
  const rgb = (bytes, x, y) => [...bytes.subarray(4 * (y * width + x), 4 * (y * width + x) + 3)];
  const found = { pixels: 0, file: 0, picture: 0, pictureSum: 0, brightest: 0 };
  const step = Math.max(1, Math.floor(Math.sqrt((width * height) / 4000)));
  for (let y = step; y < height - 1; y += step)
    for (let x = step; x < width - 1; x += step) {
      const expected = expectedAt(glb, x, y, result);
      if (expected === null) continue;
      const seen = rgb(drawn, x, height - 1 - y);
      const inPicture = difference(seen, rgb(picture, x, y));
      found.pixels += 1;
      found.file = Math.max(found.file, difference(seen, expected));
      found.picture = Math.max(found.picture, inPicture);
      found.pictureSum += inPicture;
      found.brightest = Math.max(found.brightest, ...seen);
    }
  return found;
}

async function validate() {
  const validator = createRequire(resolve(packages, "index.js"))("gltf-validator");
  const bytes = new Uint8Array(readFileSync(join(solution, "solution.glb")));
  return (await validator.validateBytes(bytes)).issues;
}

const problems = [];
const issues = await validate();
if (issues.numErrors + issues.numWarnings > 0)
  problems.push(`the validator says: ${JSON.stringify(issues.messages.slice(0, 3))}`);

const result = await drawInBrowser();
if (result.error) throw new Error(result.error);
const screenshot = join(packages, "solution.png");
writeFileSync(screenshot, Buffer.from(result.screenshot.split(",")[1], "base64"));
const found = compare(readGlb(join(solution, "solution.glb")), result);
const mean = found.pictureSum / found.pixels;
console.log(
  `${found.pixels} pixels; of 255, at most ${found.file.toFixed(2)} from the colours of the file, ` +
    `${found.picture} (mean ${mean.toFixed(2)}) from view.png; ${screenshot}`,
);
if (!(found.pixels >= 1000 && found.brightest > 128)) problems.push("hardly anything is drawn");
// A browser rounds once and its floats are short.
if (found.file > 1.5) problems.push("the browser does not show the colours of the file");
// Triangles are not the curved interpolation of the picture, and white is cut off per vertex.
if (mean > 2 || found.picture > 24) problems.push("the browser does not show view.png");
for (const problem of problems) console.error(`check-glb: ${problem}`);
process.exit(problems.length > 0 ? 1 : 0);
