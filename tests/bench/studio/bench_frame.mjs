#!/usr/bin/env node
// The studio's part of a drawn frame on the processor: from the browser's call of the frame loop to its return, in which are the
// playout, the pose, what is handed to the graphics card, and three.js. What the card draws is not in it. The sample head, and the
// same with every triangle cut into four; as fast as this machine is and 4 times slower; deformed by the shader and by the kernel.
//   node tests/bench/studio/bench_frame.mjs [BUILD] [FRAMES]
// BUILD: the build folder (build); FRAMES: frames of a row (200). Needs web/dist.

import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../../..', import.meta.url));
const { chromium } = createRequire(join(root, 'web/package.json'))('playwright-core');
const build = resolve(process.argv[2] ?? join(root, 'build'));
const frames = Number(process.argv[3] ?? 200);
const sample = join(build, 'sample/sample-head.glb');
const patience = 600_000; // ms

/** The positions and triangles of a GLB as OBJ, a group for each mesh, every triangle cut into four. */
function cutIntoFour(path) {
  const file = readFileSync(path);
  const jsonSize = file.readUInt32LE(12);
  const { accessors, bufferViews, meshes, nodes } = JSON.parse(file.toString('utf8', 20, 20 + jsonSize));
  const read = (index) => {
    const { bufferView, byteOffset = 0, componentType, count, type } = accessors[index];
    const Kind = { 5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array }[componentType];
    const at = 28 + jsonSize + (bufferViews[bufferView].byteOffset ?? 0) + byteOffset;
    const length = count * (type === 'VEC3' ? 3 : 1);
    return new Kind(file.buffer.slice(file.byteOffset + at, file.byteOffset + at + length * Kind.BYTES_PER_ELEMENT));
  };
  const lines = [];
  let first = 1;
  for (const { mesh: number, translation = [0, 0, 0] } of nodes.filter(({ mesh }) => mesh !== undefined)) {
    const { name, primitives } = meshes[number];
    for (const { attributes, indices } of primitives) {
      const from = read(attributes.POSITION);
      const places = Array.from({ length: from.length / 3 }, (_, v) => [0, 1, 2].map((axis) => from[v * 3 + axis] + translation[axis]));
      const middles = new Map();
      const middle = (a, b) => {
        const edge = a < b ? `${a},${b}` : `${b},${a}`;
        if (!middles.has(edge)) middles.set(edge, places.push(places[a].map((x, axis) => (x + places[b][axis]) / 2)) - 1);
        return middles.get(edge);
      };
      const corners = read(indices);
      const triangles = [];
      for (let i = 0; i < corners.length; i += 3) {
        const [a, b, c] = corners.subarray(i, i + 3);
        const [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        triangles.push([a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]);
      }
      lines.push(`o ${name}`, ...places.map((place) => `v ${place.join(' ')}`), ...triangles.map((three) => `f ${three.map((v) => v + first).join(' ')}`));
      first += places.length;
    }
  }
  return lines.join('\n');
}

async function json(url, options) {
  const answer = await fetch(url, options);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${await answer.text()}`);
  return answer.json();
}

async function until(state, url) {
  for (;;) {
    const model = await fetch(url).then((answer) => (answer.ok ? answer.json() : null), () => null);
    if (model?.state === state) return model;
    if (model?.state === 'failed') throw new Error(JSON.stringify(model.problem));
    await new Promise((done) => setTimeout(done, 200));
  }
}

/** Uploads a head with the sample's points and parametrizes it. */
async function makeHead(server, obj) {
  const { model: { id } } = await json(`${server}/v1/models?name=Cut`, { method: 'POST', headers: { 'Content-Type': 'model/obj' }, body: obj });
  const url = `${server}/v1/models/${id}`;
  await until('ready', url);
  const { points } = JSON.parse(readFileSync(join(build, 'sample/sample-head.fps.json'), 'utf8'));
  const places = Object.fromEntries(Object.entries(points).map(([point, { position }]) => [point, { position }]));
  const headers = { 'Content-Type': 'application/json' };
  await json(`${url}/feature-points`, { method: 'PUT', headers, body: JSON.stringify({ points: places }) });
  await json(`${url}/parametrizations`, { method: 'POST', headers, body: '{}' });
  await until('parametrized', url);
  return id;
}

/** Runs in the page before its scripts: notes how long each call of the frame loop takes. */
function timeFrames() {
  const ask = window.requestAnimationFrame.bind(window);
  window.frameTimes = [];
  window.requestAnimationFrame = (call) =>
    ask((time) => {
      const drawn = window.semblante?.scene.stage.drawn;
      const start = performance.now();
      call(time);
      if (window.semblante?.scene.stage.drawn !== drawn) window.frameTimes.push(performance.now() - start);
    });
}

async function measure(browser, server, model, path, slowdown) {
  const context = await browser.newContext({ viewport: { width: 390, height: 500 }, deviceScaleFactor: 0.25 });
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  await page.addInitScript(timeFrames);
  const session = await context.newCDPSession(page);
  await page.goto(`${server}/#${model}/live?stream=demo`, { timeout: patience });
  await page.waitForFunction(() => window.semblante?.scene.state.value.kind === 'ready' && window.semblante.driver.source.value === 'stream');
  await page.evaluate((to) => (window.semblante.scene.deformPath = to), path);
  await session.send('Emulation.setCPUThrottlingRate', { rate: slowdown });
  const counted = async (count) => {
    await page.evaluate(() => (window.frameTimes.length = 0));
    await page.waitForFunction((wanted) => window.frameTimes.length >= wanted, count);
    return page.evaluate(() => window.frameTimes.slice().sort((a, b) => a - b));
  };
  await counted(frames / 2); // compiled by then
  const times = await counted(frames);
  const vertices = await page.evaluate(() => window.semblante.scene.face.mesh.vertexCount);
  await context.close();
  return { vertices, median: times[times.length >> 1], p95: times[Math.floor(times.length * 0.95)] };
}

const data = mkdtempSync(join(tmpdir(), 'semblante-frame-'));
const port = 18_000 + (process.pid % 10_000);
const url = `http://127.0.0.1:${port}`;
const child = spawn(
  join(build, 'bin/semblante'),
  ['serve', '--port', String(port), '--data', data, '--web-root', join(root, 'web/dist'), '--sample', sample, '--demo', '--log-level', 'error'],
  { stdio: ['ignore', 'ignore', 'inherit'] },
);
const browser = await chromium.launch({
  executablePath: process.env['SEMBLANTE_CHROMIUM'] ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--enable-unsafe-swiftshader'],
});
try {
  await until('parametrized', `${url}/v1/models/sample`);
  const cut = await makeHead(url, cutIntoFour(sample));
  console.log('| vertices | deformed by | processor | median, ms | p95, ms |');
  console.log('|---|---|---|---|---|');
  for (const model of ['sample', cut]) {
    for (const path of ['gpu', 'wasm']) {
      for (const slowdown of [1, 4]) {
        const { vertices, median, p95 } = await measure(browser, url, model, path, slowdown);
        console.log(`| ${vertices} | ${path === 'gpu' ? 'shader' : 'kernel'} | ${slowdown === 1 ? 'this one' : `${slowdown} x slower`} | ${median.toFixed(1)} | ${p95.toFixed(1)} |`);
      }
    }
  }
} finally {
  await browser.close();
  child.kill();
  await new Promise((done) => child.once('exit', done));
  rmSync(data, { recursive: true, force: true });
}
