#!/usr/bin/env node
// The page of a stream on a phone: time to the first moving face, bytes until then, and frames a second, by network and
// processor. Starts the built server with the sample head and the demo stream; headless Chromium throttles the processor, a
// TCP proxy is the network, so that WebSockets are slow too.
//   node tests/bench/phone/bench_phone.mjs [BUILD] [SECONDS] [PICTURES]
// BUILD: the build folder (build); SECONDS: how long frames are counted (10); PICTURES: a folder for a picture of each row.

import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath } from 'node:url';

const root = fileURLToPath(new URL('../../..', import.meta.url));
const { chromium } = createRequire(join(root, 'web/package.json'))('playwright-core');
const build = resolve(process.argv[2] ?? join(root, 'build'));
const seconds = Number(process.argv[3] ?? 10);
const pictures = process.argv[4];

/**
 * What the proxy is told (tests/support/tcp_proxy.h): delays in ms each way, bandwidth in bytes a second. The bandwidth is
 * that of each connection, of which Chromium opens up to six: the page as a whole has more.
 */
const networks = [
  { name: 'loopback', proxy: [] },
  { name: '4G: 9 Mbit/s, 85 ms', proxy: ['delay=42', 'jitter=15', 'bandwidth=1125000'] },
  { name: 'slow 3G: 400 kbit/s, 400 ms', proxy: ['delay=200', 'bandwidth=50000'] },
  { name: 'lossy: 2 Mbit/s, 120 ms, 3 % sent again', proxy: ['delay=60', 'jitter=40', 'bandwidth=250000', 'stalls=0.03', 'stall=300'] },
];
const slowdowns = [1, 4];
const patience = 120_000; // ms

function start(program, args) {
  const child = spawn(join(build, 'bin', program), args, { stdio: ['pipe', 'pipe', 'inherit'] });
  const lines = createInterface({ input: child.stdout });
  return { child, lines };
}

async function ready(url) {
  for (;;) {
    const answer = await fetch(url).catch(() => null);
    if (answer?.ok && (await answer.json()).state === 'parametrized') return;
    await new Promise((done) => setTimeout(done, 100));
  }
}

/** One row: a fresh browser profile, so that nothing is cached. */
async function measure(browser, port, slowdown, picture) {
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, deviceScaleFactor: 2 });
  const page = await context.newPage();
  page.setDefaultTimeout(patience);
  const session = await context.newCDPSession(page);
  await session.send('Network.enable');
  await session.send('Emulation.setCPUThrottlingRate', { rate: slowdown });
  let loaded = 0;
  let received = 0;
  session.on('Network.loadingFinished', ({ encodedDataLength }) => (loaded += encodedDataLength));
  session.on('Network.webSocketFrameReceived', ({ response }) => {
    received += response.opcode === 2 ? Buffer.byteLength(response.payloadData, 'base64') : response.payloadData.length;
  });
  const began = performance.now();
  await page.goto(`http://127.0.0.1:${port}/view/demo`, { waitUntil: 'commit', timeout: patience });
  await page.waitForFunction(() => globalThis.semblanteFace?.state === 'playing', null, { polling: 50 });
  const row = { moving: performance.now() - began, bytes: loaded };
  const before = received;
  const counted = [];
  for (let second = 0; second < seconds; ++second) {
    await page.waitForTimeout(1000);
    counted.push(await page.evaluate(() => globalThis.semblanteFace.stats));
  }
  const last = counted.at(-1);
  row.frames = counted.reduce((sum, one) => sum + one.framesPerSecond, 0) / counted.length;
  row.rate = ((received - before) * 8) / 1000 / seconds;
  row.vertices = last.vertices;
  row.delay = last.delay;
  if (picture) await page.screenshot({ path: picture });
  await context.close();
  return row;
}

const data = mkdtempSync(join(tmpdir(), 'semblante-phone-'));
const port = 18_000 + (process.pid % 10_000);
const server = start('semblante', [
  ...['serve', '--port', String(port), '--data', data, '--web-root', join(root, 'web/dist')],
  ...['--sample', join(build, 'sample/sample-head.glb'), '--demo', '--log-level', 'error'],
]);
server.lines.on('line', () => {});
const browser = await chromium.launch({
  executablePath: process.env['SEMBLANTE_CHROMIUM'] ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--enable-unsafe-swiftshader'],
});
try {
  await ready(`http://127.0.0.1:${port}/v1/models/sample`);
  console.log('| network | processor | face moves after | bytes until then | frames/s | vertices | delay | stream |');
  console.log('|---|---|---|---|---|---|---|---|');
  for (const { name, proxy } of networks) {
    for (const slowdown of slowdowns) {
      const network = start('semblante-test-proxy', [String(port), ...proxy]);
      const entry = Number(await new Promise((done) => network.lines.once('line', done)));
      const picture = pictures && join(pictures, `${name.split(':')[0].replace(' ', '-')}-${slowdown}x.png`);
      const row = await measure(browser, entry, slowdown, picture);
      network.child.kill();
      console.log(
        `| ${name} | ${slowdown === 1 ? 'this one' : `${slowdown} x slower`} | ${(row.moving / 1000).toFixed(1)} s | ` +
          `${(row.bytes / 1000).toFixed(0)} kB | ${row.frames.toFixed(0)} | ${row.vertices} | ${row.delay.toFixed(0)} ms | ` +
          `${row.rate.toFixed(1)} kbit/s |`,
      );
    }
  }
} finally {
  await browser.close();
  server.child.kill();
  await new Promise((done) => server.child.once('exit', done));
  rmSync(data, { recursive: true, force: true });
}
