// node kernel_wasm_test.mjs MODULE.wasm VECTORS.json: the module gives the golden numbers, to the last bit.
import assert from "node:assert/strict";
import fs from "node:fs";
import { WasmKernel } from "./wasm_kernel.mjs";

const [, , modulePath, vectorsPath] = process.argv;
const bytes = fs.readFileSync(modulePath);
const vectors = JSON.parse(fs.readFileSync(vectorsPath, "utf8"));

const module = new WebAssembly.Module(bytes);
assert.deepEqual(WebAssembly.Module.imports(module), [], "the module asks nothing of its host");
assert.deepEqual(
  WebAssembly.Module.exports(module).map((e) => e.name).sort(),
  ["memory", "semblante_alloc", "semblante_deform", "semblante_deform_changed", "semblante_deform_prepared",
    "semblante_evaluate", "semblante_free_all", "semblante_interpolate", "semblante_prepare", "semblante_prepared_size",
    "semblante_sincos"],
  "the export list is the interface");
assert.ok(bytes.length < 32768, `the module is small (${bytes.length} bytes)`);

const kernel = new WasmKernel(bytes);
const rig = kernel.rig(vectors.rig);
const face = kernel.face(vectors.face);
const poses = vectors.cases.map((c) => kernel.evaluate(rig, kernel.frame(c.frame)));
const f32 = (numbers) => Float32Array.from(numbers);
vectors.cases.forEach((c, i) => {
  const expected = new Float32Array(84 * 3);
  for (const [fp, d] of Object.entries(c.displacements)) expected.set(d, Number(fp) * 3);
  // + 0: zero has two signs, which are equal here
  assert.deepEqual(kernel.displacements(poses[i]).map((x) => x + 0), expected, `${c.name}: displacements`);
  assert.deepEqual(kernel.deform(face, poses[i]).map((x) => x + 0), f32(c.positions), `${c.name}: positions`);
  assert.deepEqual(kernel.deformPrepared(face, poses[i]).map((x) => x + 0), f32(c.positions), `${c.name}: prepared`);
});
for (const { from, to, t, positions } of vectors.interpolations) {
  assert.deepEqual(kernel.deform(face, kernel.interpolate(poses[from], poses[to], t)), f32(positions), `${from}..${to}`);
}

// The allocator: aligned, apart, growing past the first page, refusing what cannot be, and starting over when told.
const { semblante_alloc: alloc, semblante_free_all: freeAll, memory } = kernel.exports;
const first = alloc(5);
const second = alloc(1);
assert.ok(first % 16 === 0 && second % 16 === 0 && second >= first + 5);
const before = memory.buffer.byteLength;
const large = alloc(3 << 20);
assert.ok(large > second && memory.buffer.byteLength >= before + (2 << 20));
new Uint8Array(memory.buffer, large, 3 << 20).fill(1); // inside the memory, or this throws
assert.equal(alloc(0xfffffff0), 0);
assert.ok(alloc(16) >= large + (3 << 20), "a refusal takes nothing");
freeAll();
assert.ok(alloc(16) < large);

console.log(`${vectors.cases.length} frames, ${vectors.interpolations.length} interpolations: equal to the last bit`);
