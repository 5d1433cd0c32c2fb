// From a moment of a microphone's sound to its mouth in a page: ms, in Chromium with a microphone that says a tone. What
// microphone, system and screen take is not in it.
//   node bench_delay.mjs BUILD
import { readFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { join } from 'node:path';
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
const { delays, sampleRate } = await page.evaluate(async () => {
  const { Microphone } = await import('/listen.js');
  const found = [];
  const microphone = await Microphone.open(
    { library: async () => (await fetch('/semblante_listen.wasm')).arrayBuffer(), worklet: '/listen_worklet.js' },
    ({ delay }) => found.push(delay),
  );
  await new Promise((wake) => setTimeout(wake, 12_000));
  microphone.close();
  return { delays: found.slice(100), sampleRate: new AudioContext().sampleRate };
});
await browser.close();
server.close();
delays.sort((a, b) => a - b);
const at = (share) => delays[Math.floor((delays.length - 1) * share)].toFixed(1);
console.log(`${delays.length} mouths at ${sampleRate} Hz: least ${at(0)}, median ${at(0.5)}, nine in ten ${at(0.9)}, 99 in 100 ${at(0.99)} ms`);
