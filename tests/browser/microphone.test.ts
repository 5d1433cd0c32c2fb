import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect, test } from 'vitest';
import { vowel } from '../unit/ts/support/voice.ts';
import { startServer, type RunningServer } from './support/server.ts';
import { launch, StudioPage } from './support/studio_page.ts';

const rate = 48_000;

/** "a" for 0.6 s, and silence for 0.6 s, as a WAV file. */
function voice(): Buffer {
  const count = 1.2 * rate;
  const samples = new Float64Array(count);
  samples.set(vowel(rate, 0.6));
  const file = Buffer.alloc(44 + 2 * count);
  file.write('RIFF', 0);
  file.writeUInt32LE(36 + 2 * count, 4);
  file.write('WAVEfmt ', 8);
  file.writeUInt32LE(16, 16);
  file.writeUInt16LE(1, 20);
  file.writeUInt16LE(1, 22);
  file.writeUInt32LE(rate, 24);
  file.writeUInt32LE(2 * rate, 28);
  file.writeUInt16LE(2, 32);
  file.writeUInt16LE(16, 34);
  file.write('data', 36);
  file.writeUInt32LE(2 * count, 40);
  samples.forEach((value, n) => file.writeInt16LE(Math.round(9000 * value), 44 + 2 * n));
  return file;
}

interface Inside {
  semblante: {
    microphone: { delay: number };
    scene: { performer: { value: { pose: { points: Float32Array } } } };
    driver: { shownFrame(): { state: { viseme: { select1: number; select2: number; blend: number } } } | null };
  };
}

let folder: string;
let server: RunningServer;
let browser: Browser;
let studio: StudioPage;

beforeAll(async () => {
  folder = mkdtempSync(join(tmpdir(), 'semblante-voice-'));
  const file = join(folder, 'voice.wav');
  writeFileSync(file, voice());
  [server, browser] = await Promise.all([
    startServer({ demo: false }),
    launch(['--use-fake-device-for-media-stream', `--use-file-for-fake-audio-capture=${file}`]),
  ]);
});
afterEach(async () => studio?.close());
afterAll(async () => {
  await browser?.close();
  await server?.stop();
  rmSync(folder, { recursive: true, force: true });
});

async function open(): Promise<StudioPage> {
  const page = await StudioPage.open(browser, server.url, { coarse: true });
  await page.waitForStage('ready');
  await page.page.getByRole('tab', { name: 'Animate' }).click();
  return page;
}

/** Resolves when the mouth of the page shows this viseme, or none (0), for most of it. */
async function shows(page: StudioPage, viseme: number): Promise<void> {
  await page.page.waitForFunction((wanted) => {
    const { select1, select2, blend } = (window as unknown as Inside).semblante.driver.shownFrame()!.state.viseme;
    return (select1 === wanted && blend > 40) || (select2 === wanted && blend < 23);
  }, viseme);
}

test('Microphone_Allowed_MovesTheMouthAtOnce_AndStops', async () => {
  studio = await open();
  const { page } = studio;
  await studio.context.grantPermissions(['microphone'], { origin: server.url });
  await page.getByRole('button', { name: 'Use the microphone' }).click();
  await page.locator('.driver').getByText('Listening').waitFor();
  await shows(studio, 10); // "a"
  await shows(studio, 0);
  await shows(studio, 10);
  const delays: number[] = [];
  while (delays.length < 50) {
    delays.push(await page.evaluate(() => (window as unknown as Inside).semblante.microphone.delay));
    await page.waitForTimeout(30);
  }
  delays.sort((a, b) => a - b);
  console.info(`delay, ms: least ${delays[0]!.toFixed(1)}, median ${delays[25]!.toFixed(1)}, greatest ${delays[49]!.toFixed(1)}`);
  expect(delays[0]).toBeGreaterThan(52); // it cannot hear what has not been said
  await page.getByRole('button', { name: 'Stop the microphone' }).click();
  await page.locator('.driver').getByText('By hand').waitFor();
  await shows(studio, 0);
  expect(studio.errors).toEqual([]);
});

test('Microphone_Refused_IsSaidInWords', async () => {
  studio = await open();
  const { page } = studio;
  await page.getByRole('button', { name: 'Use the microphone' }).click();
  await page.getByRole('alert').getByText('The microphone was not allowed').waitFor();
  await page.locator('.driver').getByText('By hand').waitFor();
  expect(studio.errors).toEqual([]);
});
