// A stream that talks, heard and seen by clients in a real browser behind a network that jitters and breaks; one joins late.
// SEMBLANTE_SOUND_SECONDS: how long; then the goal of 40 ms at p99 is asserted too, which wants a machine that does nothing
// else. SEMBLANTE_SOUND_NETWORK: another one, in the words of semblante-test-proxy.
import { copyFileSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { build } from 'esbuild';
import type { Page } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { BadNetwork } from './support/network.ts';
import { buildDir, root } from './support/paths.ts';
import { eventually, patience } from './support/patience.ts';
import { startServer, type RunningServer } from './support/server.ts';
import { browser, useBrowser } from './support/suite.ts';

const measured = process.env['SEMBLANTE_SOUND_SECONDS'];
const seconds = Number(measured ?? 12);
const kind = (process.env['SEMBLANTE_SOUND_NETWORK'] ?? 'delay=20 jitter=60').split(' ');

/** What a page saw and heard: of each display frame with sound the difference in media time, ms. */
interface Watched {
  skews: number[];
  /** ms of sound */
  heard: number;
  /** Display frames in silence, and those that came too late by the fault of the machine. */
  silent: number;
  late: number;
  headers: number;
  resumed: number;
  /** How much later than the face would be shown without sound the sound is heard, ms. */
  behind: number[];
}

/** Runs in the page. What is heard is read from what the audio graph was told to play, not from what the client believes. */
const script = `
import { Player, Runtime, StreamClient, streamUrl } from '${join(root, 'clients/js/index.ts')}';
import { StreamSound } from '${join(root, 'clients/js/sound/index.ts')}';

let context = null;
let decoded = NaN;
const played = [];
const Context = globalThis.AudioContext;
globalThis.AudioContext = class extends Context {
  constructor(options) {
    super(options);
    context = this;
  }
};
const Decoder = globalThis.AudioDecoder;
globalThis.AudioDecoder = class extends Decoder {
  constructor({ output, error }) {
    const given = [];
    super({ error, output: (data) => {
      decoded = { mediaTime: given.shift(), duration: (data.numberOfFrames / data.sampleRate) * 1000 };
      output(data);
    } });
    this.given = given; // media times of packets, in order: the decoder gives one piece of sound for each
  }
  decode(chunk) {
    this.given.push(chunk.timestamp / 1000);
    super.decode(chunk);
  }
};
const start = AudioBufferSourceNode.prototype.start;
AudioBufferSourceNode.prototype.start = function (at) {
  start.call(this, at);
  played.push({ ...decoded, at: at * 1000, length: this.buffer.duration * 1000 });
};
/** The media time that comes out of the loudspeaker; NaN in silence. */
function heard() {
  const now = (context.currentTime - (context.outputLatency || context.baseLatency || 0)) * 1000;
  while (played.length > 1 && now >= played[1].at) played.shift();
  const [first] = played;
  const since = first ? now - first.at : NaN;
  return since >= 0 && since < first.length ? first.mediaTime + (since * first.duration) / first.length : NaN;
}

export async function watch() {
  await Runtime.load(async () => new Uint8Array(await (await fetch('/semblante_view.wasm')).arrayBuffer()));
  const client = new StreamClient(streamUrl(location.origin, 'talk'), { sound: true });
  const player = new Player({ evaluateAt() {}, interpolate() {} }, { clock: () => sound.mediaTime });
  const sound = new StreamSound(client, player);
  player.follow(client);
  const watched = { skews: [], heard: 0, silent: 0, late: 0, headers: 0, resumed: 0, behind: [] };
  client.on('header', ({ recovered }) => {
    watched.headers += 1;
    watched.resumed += recovered ? 1 : 0;
  });
  client.connect();
  await new Promise((resolve) => client.on('header', resolve));
  await sound.start();
  let before = performance.now();
  const show = () => {
    const now = performance.now();
    player.update((now - before) / 1000);
    const skew = player.playhead - heard();
    if (!Number.isNaN(skew)) watched.heard += now - before;
    if (now - before > 100) watched.late += 1;
    else if (Number.isNaN(skew)) watched.silent += 1;
    else {
      watched.skews.push(skew);
      watched.behind.push(client.streamClock.mediaTime - player.delay - heard());
    }
    before = now;
    requestAnimationFrame(show);
  };
  requestAnimationFrame(show);
  globalThis.watched = watched;
}
`;

let server: RunningServer;
let network: BadNetwork;
let pages: string;

useBrowser(['--autoplay-policy=no-user-gesture-required']);
beforeAll(async () => {
  pages = mkdtempSync(join(tmpdir(), 'semblante-talk-'));
  await build({ stdin: { contents: script, resolveDir: root }, outfile: join(pages, 'talk.js'), bundle: true, format: 'iife', globalName: 'talk', target: 'es2022' });
  writeFileSync(join(pages, 'talk.html'), '<!doctype html><title>Talk</title><script src="talk.js"></script>');
  copyFileSync(join(buildDir, 'wasm/semblante_view.wasm'), join(pages, 'semblante_view.wasm'));
  server = await startServer({ demo: false, pages, voice: join(root, 'server/voice/examples/beeps.py') });
  network = await BadNetwork.before(server, kind);
});
afterAll(async () => {
  network?.close();
  await server?.stop();
  rmSync(pages, { recursive: true, force: true });
});

const ask = (method: string, path: string, body: object): Promise<Response> =>
  fetch(`${server.url}${path}`, { method, headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) });

async function open(): Promise<Page> {
  const page = await browser.newPage();
  page.setDefaultTimeout(patience);
  await page.goto(`${network.address}/talk.html`);
  await page.evaluate(() => (window as unknown as { talk: { watch(): Promise<void> } }).talk.watch());
  return page;
}
const watched = (page: Page): Promise<Watched> => page.evaluate(() => (window as unknown as { watched: Watched }).watched);

function quantile(values: readonly number[], share: number): number {
  const sorted = values.map(Math.abs).sort((a, b) => a - b);
  return sorted[Math.floor((sorted.length - 1) * share)]!;
}
const mean = (values: readonly number[]): number => values.reduce((sum, one) => sum + one, 0) / values.length;

test('SoundAndFace_StayTogether_ThroughJitterStallsALostConnectionAndALateJoin', async () => {
  expect((await ask('POST', '/v1/streams', { name: 'talk' })).status).toBe(201);
  const text = Array.from({ length: 12 }, () => 'Mamma mia, what a long talk about nothing at all.').join(' ');
  const talking = setInterval(() => void ask('POST', '/v1/streams/talk/speech', { text, language: 'en' }), 500); // 409 while it talks
  try {
    const first = await open();
    const enough = (page: Page, share: number) => eventually('enough was heard', async () => (await watched(page)).heard > 1000 * seconds * share);
    await enough(first, 1 / 3);
    network.tell('cut');
    await enough(first, 2 / 3);
    const second = await open();
    await Promise.all([enough(first, 1), enough(second, 1 / 3)]);
    for (const [name, page] of [['first', first], ['late', second]] as const) {
      const { skews, silent, late, headers, resumed, behind } = await watched(page);
      const part = Math.min(3600, Math.floor(behind.length / 3)); // up to a minute
      console.log(
        `${name}: ${skews.length} display frames with sound, ${silent} in silence, ${late} late by the machine; skew p50 ${quantile(skews, 0.5).toFixed(2)}, ` +
          `p99 ${quantile(skews, 0.99).toFixed(2)}, worst ${quantile(skews, 1).toFixed(2)} ms; ${headers} headers, ${resumed} resumed; ` +
          `behind the face's delay ${mean(behind.slice(part, 2 * part)).toFixed(1)}, then ${mean(behind.slice(-part)).toFixed(1)} ms`,
      );
      expect(quantile(skews, measured === undefined ? 0.5 : 0.99), name).toBeLessThanOrEqual(40);
      expect(silent, name).toBeLessThan(skews.length); // a third of it are pauses
      expect(headers, name).toBe(name === 'first' ? 2 : 1);
    }
  } finally {
    clearInterval(talking);
  }
});
