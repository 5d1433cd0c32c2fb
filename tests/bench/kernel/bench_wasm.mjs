// The kernel's WebAssembly module beside the native library and beside a plain JavaScript loop, on the same heads.
//   build/bin/bench_kernel --write DIR
//   node bench_wasm.mjs MODULE.wasm build/bin/bench_kernel DIR/*.head
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";

const poseBytes = 1436; // sizeof(semblante_pose)
const rounds = 12;

function readHead(file) {
  const bytes = fs.readFileSync(file);
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength);
  const [vertices, entries, triangles] = new Uint32Array(buffer, 4, 3);
  let at = 16;
  const take = (Type, count) => {
    const array = new Type(buffer, at, count);
    at += count * Type.BYTES_PER_ELEMENT;
    return array;
  };
  const rest = take(Float32Array, vertices * 3);
  const offsets = take(Uint32Array, vertices + 1);
  const weights = take(Float32Array, entries);
  take(Uint32Array, triangles * 3);
  const pose = take(Float32Array, poseBytes / 4);
  return { vertices, rest, offsets, weights, pose, points: take(Uint8Array, entries), rigid: take(Uint8Array, vertices),
    turn: take(Uint8Array, vertices) };
}

/** What a good JavaScript programmer would write without WebAssembly. Lids move by Eq. 7 alone. */
function plainDeform({ vertices, rest, offsets, weights, points, rigid, turn }, pose, positions) {
  const matrix = (q) => matrixOf(pose[q], pose[q + 1], pose[q + 2], pose[q + 3]);
  const matrixOf = (x, y, z, w) => [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 2 * (x * y + w * z),
      1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)];
  const eyes = [matrix(252), matrix(256)];
  const [h0, h1, h2, h3, h4, h5, h6, h7, h8] = matrix(266);
  const hx = pose[276];
  const hy = pose[277];
  const hz = pose[278];
  const turnPartly = (share, i) => {
    const side = pose[269] < 0 ? -share : share;
    const q = [side * pose[266], side * pose[267], side * pose[268], 1 - share + side * pose[269]];
    const length = Math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const m = matrixOf(q[0] / length, q[1] / length, q[2] / length, q[3] / length);
    const a = positions[i] - hx;
    const b = positions[i + 1] - hy;
    const c = positions[i + 2] - hz;
    positions[i] = m[0] * a + m[1] * b + m[2] * c + hx;
    positions[i + 1] = m[3] * a + m[4] * b + m[5] * c + hy;
    positions[i + 2] = m[6] * a + m[7] * b + m[8] * c + hz;
  };
  let k = 0;
  for (let v = 0, i = 0; v < vertices; v += 1, i += 3) {
    let x = rest[i];
    let y = rest[i + 1];
    let z = rest[i + 2];
    for (const end = offsets[v + 1]; k < end; k += 1) {
      const w = weights[k];
      const d = points[k] * 3;
      x += w * pose[d];
      y += w * pose[d + 1];
      z += w * pose[d + 2];
    }
    const part = rigid[v];
    if (part !== 0 && part < 5) {
      const eye = (part - 1) & 1;
      const m = eyes[eye];
      const px = pose[270 + eye * 3];
      const py = pose[271 + eye * 3];
      const pz = pose[272 + eye * 3];
      const a = x - px;
      const b = y - py;
      const c = z - pz;
      x = m[0] * a + m[1] * b + m[2] * c + px + pose[260 + eye * 3];
      y = m[3] * a + m[4] * b + m[5] * c + py + pose[261 + eye * 3];
      z = m[6] * a + m[7] * b + m[8] * c + pz + pose[262 + eye * 3];
    }
    if (turn[v] !== 255) {
      positions[i] = x;
      positions[i + 1] = y;
      positions[i + 2] = z;
      if (turn[v] !== 0) turnPartly(turn[v] / 255, i);
      continue;
    }
    const a = x - hx;
    const b = y - hy;
    const c = z - hz;
    positions[i] = h0 * a + h1 * b + h2 * c + hx;
    positions[i + 1] = h3 * a + h4 * b + h5 * c + hy;
    positions[i + 2] = h6 * a + h7 * b + h8 * c + hz;
  }
}

/** The head in an instance of the module; what to call for a frame. */
function inModule(module, head) {
  const exports = new WebAssembly.Instance(module).exports;
  const put = (array) => {
    const at = exports.semblante_alloc(array.byteLength);
    new array.constructor(exports.memory.buffer, at, array.length).set(array);
    return at;
  };
  const face = put(Uint32Array.of(head.vertices, put(head.rest), put(head.offsets), put(head.points), put(head.weights),
    put(head.rigid), put(head.turn)));
  const pose = put(head.pose);
  const positions = exports.semblante_alloc(head.vertices * 12);
  // Of the rig, only the eyes count here; they are in the pose too (offsets: core/kernel/README.md).
  const rig = new Uint8Array(372);
  const inPose = new Uint8Array(head.pose.buffer, head.pose.byteOffset, head.pose.byteLength);
  rig.set(inPose.subarray(1080, 1104), 28);
  rig.set(inPose.subarray(1236, 1436), 172);
  const memory = exports.semblante_alloc(exports.semblante_prepared_size(face));
  const prepared = exports.semblante_prepare_for(face, put(rig), memory);
  return {
    deform: () => exports.semblante_deform_prepared(prepared, pose, positions),
    positions: () => new Float32Array(exports.memory.buffer, positions, head.vertices * 3),
  };
}

function bestOf(frame, seconds) {
  let best = Infinity;
  const end = performance.now() + seconds * 1000;
  while (performance.now() < end) {
    const begin = performance.now();
    frame();
    frame();
    best = Math.min(best, (performance.now() - begin) / 2000);
  }
  return best;
}

const [, , modulePath, native, ...files] = process.argv;
if (files.length > 1) {
  // Each head in a process of its own: what the engine learns on one it holds against the next.
  for (const file of files) execFileSync(process.execPath, [process.argv[1], modulePath, native, file], { stdio: "inherit" });
  process.exit(0);
}
const module = new WebAssembly.Module(fs.readFileSync(modulePath));
for (const file of files) {
  const head = readHead(file);
  const wasm = inModule(module, head);
  const plain = new Float32Array(head.vertices * 3);
  wasm.deform();
  plainDeform(head, head.pose, plain);
  const found = wasm.positions();
  const slides = (i) => head.rigid[Math.floor(i / 3)] === 5 || head.rigid[Math.floor(i / 3)] === 6; // a lid
  const wrong = plain.findIndex((x, i) => !slides(i) && !(Math.abs(x - found[i]) <= 1e-5 * (1 + Math.abs(x))));
  if (wrong >= 0) throw new Error(`${file}: the loops differ at vertex ${Math.floor(wrong / 3)}`);
  // Until the engine has compiled both for good. Short calls first: what a first call that never ends taught it about
  // types would be thrown away, and with it the fast code.
  for (let i = 0; i < 2000; i += 1) plainDeform({ ...head, vertices: 8 }, head.pose, plain);
  bestOf(wasm.deform, 0.5);
  bestOf(() => plainDeform(head, head.pose, plain), 1);
  const best = { native: Infinity, wasm: Infinity, plain: Infinity };
  for (let round = 0; round < rounds; round += 1) {
    best.native = Math.min(best.native, Number(execFileSync(native, ["--time", file])));
    best.wasm = Math.min(best.wasm, bestOf(wasm.deform, 0.15));
    best.plain = Math.min(best.plain, bestOf(() => plainDeform(head, head.pose, plain), 0.15));
  }
  console.log(path.basename(file, ".head").padEnd(28), `native ${(best.native * 1e6).toFixed(1)} us,`,
    `wasm/native ${(best.wasm / best.native).toFixed(2)}, plain/wasm ${(best.plain / best.wasm).toFixed(2)}`);
}
