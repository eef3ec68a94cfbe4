// A GLB file, as far as hemicube writes them, and what a ray through it sees.

import { readFileSync } from "node:fs";

const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

export function readGlb(path) {
  const bytes = readFileSync(path);
  const jsonLength = bytes.readUInt32LE(12);
  const json = JSON.parse(bytes.subarray(20, 20 + jsonLength).toString());
  const binary = bytes.subarray(28 + jsonLength);
  const numbers = (index) => {
    const accessor = json.accessors[index];
    const begin = json.bufferViews[accessor.bufferView].byteOffset + (accessor.byteOffset ?? 0);
    const count = accessor.count * { SCALAR: 1, VEC3: 3 }[accessor.type];
    const read = accessor.componentType === 5126 ? "readFloatLE" : "readUInt32LE";
    return Array.from({ length: count }, (_, k) => binary[read](begin + 4 * k));
  };
  const primitives = json.meshes[0].primitives;
  const positions = numbers(primitives[0].attributes.POSITION);
  const colours = numbers(primitives[0].attributes.COLOR_0);
  const corner = (values, vertex) => values.slice(3 * vertex, 3 * vertex + 3);
  const triangles = [];
  for (const primitive of primitives) {
    const indices = numbers(primitive.indices);
    for (let k = 0; k < indices.length; k += 3) {
      const three = indices.slice(k, k + 3);
      const [a, b, c] = three.map((vertex) => corner(positions, vertex));
      const ab = subtract(b, a);
      const ac = subtract(c, a);
      const normal = cross(ab, ac);
      triangles.push({ a, ab, ac, normal, colours: three.map((v) => corner(colours, v)) });
    }
  }
  const node = json.nodes.find((each) => each.camera !== undefined);
  return { triangles, matrix: node.matrix, perspective: json.cameras[node.camera].perspective };
}

/// The linear colour at a place of the picture, x and y in 0..1 from the upper left; null where
/// there is nothing.
export function colourAt(glb, x, y) {
  const { matrix, perspective } = glb;
  const up = (1 - 2 * y) * Math.tan(perspective.yfov / 2);
  const right = (2 * x - 1) * Math.tan(perspective.yfov / 2) * perspective.aspectRatio;
  const eye = matrix.slice(12, 15);
  const ray = [0, 1, 2].map((k) => right * matrix[k] + up * matrix[4 + k] - matrix[8 + k]);
  let nearest = Infinity;
  let colour = null;
  for (const { a, ab, ac, normal, colours } of glb.triangles) {
    const facing = -dot(normal, ray);
    if (!(facing > 0)) continue; // one-sided
    const from = subtract(eye, a);
    const distance = dot(normal, from) / facing;
    if (!(distance > 0 && distance < nearest)) continue;
    const around = cross(from, ray);
    const ofB = dot(ac, around) / facing;
    const ofC = -dot(ab, around) / facing;
    const weights = [1 - ofB - ofC, ofB, ofC];
    if (!(Math.min(...weights) >= -1e-9)) continue;
    nearest = distance;
    colour = [0, 1, 2].map((k) => dot(weights, colours.map((each) => each[k])));
  }
  return colour;
}
