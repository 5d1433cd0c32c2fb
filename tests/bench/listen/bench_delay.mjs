// From a moment of a microphone's sound to its mouth in a page: ms, in Chromium with a microphone that says a tone, to the weights
// and to the display frame that draws them; then the work of the WebAssembly for a block, in Node. What microphone, system
// and screen take is not in it.
//   node bench_delay.mjs BUILD
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = fileURLToPath(new URL('../../..', import.meta.url));
const tool = (path) => import(pathToFileURL(join(root, 'web/node_modules', path)).href);
const build = process.argv[2] ?? join(root, 'build');
const { default: esbuild } = await tool('esbuild/lib/main.js');
const { chromium } = await tool('playwright-core/index.mjs');

const bundled = async (file) =>
  (await esbuild.build({ entryPoints: [join(root, 'clients/js/listen', file)], bundle: true, format: 'esm', write: false })).outputFiles[0].contents;
const files = {
  '/': ['text/html', '<!doctype html><title>delay</title>'],
  '/listen.js': ['text/javascript', await bundled('index.ts')],
  '/listen_worklet.js': ['text/javascript', await bundled('worklet.ts')],
  '/semblante_listen.wasm': ['application/wasm', readFileSync(join(build, 'wasm/semblante_listen.wasm'))],
};
const server = createServer((request, response) => {
  const [type, content] = files[request.url] ?? ['text/plain', ''];
  response.setHeader('Content-Type', type);
  response.end(content);
});
await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
const browser = await chromium.launch({
  executablePath: '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-fake-device-for-media-stream', '--use-fake-ui-for-media-stream'],
});
const page = await browser.newPage();
await page.goto(`http://127.0.0.1:${server.address().port}/`);
const { delays, drawn, frames, sampleRate } = await page.evaluate(async () => {
  const { Microphone } = await import('/listen.js');
  const found = [];
  // From each moment to the next display frame after its weights; between display frames.
  const drawn = [];
  const frames = [];
  let moments = []; // when they were said, by the page's clock
  let before = NaN;
  const frame = () => {
    const now = performance.now();
    frames.push(now - before);
    for (const moment of moments) drawn.push(now - moment);
    moments = [];
    before = now;
    requestAnimationFrame(frame);
  };
  const microphone = await Microphone.open(
    { library: async () => (await fetch('/semblante_listen.wasm')).arrayBuffer(), worklet: '/listen_worklet.js' },
    ({ delay }) => {
      found.push(delay);
      moments.push(performance.now() - delay);
    },
  );
  await new Promise((wake) => setTimeout(wake, 1_000));
  requestAnimationFrame(frame);
  await new Promise((wake) => setTimeout(wake, 12_000));
  microphone.close();
  return { delays: found.slice(100), drawn: drawn.slice(150), frames: frames.slice(30), sampleRate: new AudioContext().sampleRate };
});
await browser.close();
server.close();
const line = (of, digits = 1) => {
  of.sort((a, b) => a - b);
  const at = (share) => of[Math.round((of.length - 1) * share)].toFixed(digits);
  return `median ${at(0.5)}, 95 in 100 ${at(0.95)}, 99 in 100 ${at(0.99)}, most ${at(1)} ms`;
};
console.log(`to the weights: ${delays.length} at ${sampleRate} Hz: ${line(delays)}`);
console.log(`to the display frame: ${drawn.length}: ${line(drawn)}; between display frames: ${line(frames)}`);

const file = join(mkdtempSync(join(tmpdir(), 'semblante-delay-')), 'listener.mjs');
writeFileSync(file, await bundled('listener.ts'));
const { Listener } = await import(pathToFileURL(file).href);
rmSync(dirname(file), { recursive: true });
const rate = 48_000;
const block = 128;
const seconds = 60;
const listener = new Listener(new WebAssembly.Module(readFileSync(join(build, 'wasm/semblante_listen.wasm'))), rate);
const work = [];
let total = 0;
for (let n = 0; n < (seconds * rate) / block; n += 1) {
  const sound = Float32Array.from({ length: block }, (_, i) => 0.2 * (Math.random() - 0.5) * Math.max(0, Math.sin((6 * Math.PI * (n * block + i)) / rate)));
  const begin = performance.now();
  listener.push(sound, () => undefined);
  const took = performance.now() - begin;
  total += took;
  work.push(took);
}
console.log(`work for a block of ${block} samples (${((1000 * block) / rate).toFixed(2)} ms), WebAssembly: ${line(work, 4)}; ${((0.1 * total) / seconds).toFixed(2)} % of the time of the sound`);
