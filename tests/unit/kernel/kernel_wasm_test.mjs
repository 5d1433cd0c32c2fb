// node kernel_wasm_test.mjs MODULE.wasm small-face.json golden-frames.json: the module gives the numbers of the first to
// the last bit and those of the second within the tolerance it states.
import assert from "node:assert/strict";
import fs from "node:fs";
import { WasmKernel } from "./wasm_kernel.mjs";

const [, , modulePath, vectorsPath, goldenPath] = process.argv;
const bytes = fs.readFileSync(modulePath);
const vectors = JSON.parse(fs.readFileSync(vectorsPath, "utf8"));

const module = new WebAssembly.Module(bytes);
assert.deepEqual(WebAssembly.Module.imports(module), [], "the module asks nothing of its host");
assert.deepEqual(
  WebAssembly.Module.exports(module).map((e) => e.name).sort(),
  ["memory", "semblante_alloc", "semblante_deform", "semblante_deform_changed", "semblante_deform_prepared",
    "semblante_ease", "semblante_evaluate", "semblante_free_all", "semblante_interpolate", "semblante_join_scratch",
    "semblante_join_seams", "semblante_normals", "semblante_prepare", "semblante_prepare_for", "semblante_prepared_size",
    "semblante_rest_normals", "semblante_sincos", "semblante_turn_normals"],
  "the export list is the interface");
assert.ok(bytes.length < 40960, `the module is small (${bytes.length} bytes)`);

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

const golden = JSON.parse(fs.readFileSync(goldenPath, "utf8"));
{
  const kernel = new WasmKernel(bytes);
  const rig = kernel.rig(golden.rig);
  const face = kernel.face(golden.face);
  const mesh = kernel.triangles(golden.face);
  const { tolerance } = golden;
  const check = (pose, { name, positions, vertex_normals: normals }) => {
    const found = kernel.deformPrepared(face, pose);
    positions.forEach((x, i) => assert.ok(Math.abs(found[i] - x) <= tolerance.position, `${name}: vertex ${Math.floor(i / 3)}`));
    const turned = kernel.normals(mesh, found);
    for (let i = 0; i < normals.length; i += 3) {
      const chord = Math.hypot(turned[i] - normals[i], turned[i + 1] - normals[i + 1], turned[i + 2] - normals[i + 2]);
      const degrees = (2 * Math.asin(Math.min(1, chord / 2)) * 180) / Math.PI;
      assert.ok(degrees <= tolerance.normal_degrees, `${name}: normal ${i / 3}`);
    }
  };
  const poses = golden.cases.map((c) => {
    kernel.setLipShare(rig, c.jaw_takes_lip ? 1 : 0);
    return kernel.evaluate(rig, kernel.frame(c.frame));
  });
  golden.cases.forEach((c, i) => check(poses[i], c));
  golden.interpolations.forEach((m) => check(kernel.interpolate(poses[m.from], poses[m.to], m.t), { ...m, name: `${m.from}..${m.to}` }));
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

console.log(`${vectors.cases.length} frames, ${vectors.interpolations.length} interpolations: equal to the last bit; ${golden.cases.length} golden frames`);
