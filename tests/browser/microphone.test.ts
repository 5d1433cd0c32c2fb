import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, afterEach, expect, test } from 'vitest';
import { vowel } from '../unit/ts/support/voice.ts';
import { eventually } from './support/patience.ts';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

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
    live: { send(id: string): void; sendStatus: { value: { kind: string } } };
    microphone: { delay: number };
    scene: { performer: { value: { pose: { points: Float32Array } } } };
    driver: { shownFrame(): { state: { viseme: { select1: number; select2: number; blend: number } } } | null };
  };
}

const folder = mkdtempSync(join(tmpdir(), 'semblante-voice-'));
const heard = join(folder, 'voice.wav');
writeFileSync(heard, voice());
afterAll(() => rmSync(folder, { recursive: true, force: true }));

let studio: StudioPage;

useStudio({ demo: false }, ['--use-fake-device-for-media-stream', `--use-file-for-fake-audio-capture=${heard}`]);
afterEach(async () => studio?.close());

async function open(): Promise<StudioPage> {
  const page = await StudioPage.open(browser, server.url);
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

test('Voice_IsSentOnlyWhenItIsChosen_AndARecordingKeepsIt', async () => {
  studio = await open();
  const { page } = studio;
  const post = async (path: string, body?: object): Promise<Record<string, unknown>> => {
    const content = body ? { headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) } : {};
    return (await fetch(server.url + path, { method: 'POST', ...content })).json() as Promise<Record<string, unknown>>;
  };
  const { id: stream } = (await post('/v1/streams', { title: 'Voice' })) as { id: string };
  const recorded = async (seconds: number): Promise<Record<string, unknown>> => {
    const { id } = await post(`/v1/streams/${stream}/recordings`, {});
    await page.waitForTimeout(1000 * seconds);
    return post(`/v1/recordings/${id as string}/stop`);
  };
  await studio.context.grantPermissions(['microphone'], { origin: server.url });
  const microphone = page.getByRole('button', { name: 'Use the microphone' });
  const voice = page.getByRole('switch', { name: 'Send my voice too' });
  await microphone.click();
  await page.getByText('The sound stays on this page.').waitFor();
  await page.evaluate((id) => (window as unknown as Inside).semblante.live.send(id), stream);
  await page.waitForFunction(() => (window as unknown as Inside).semblante.live.sendStatus.value.kind === 'open');
  await shows(studio, 10);
  expect(await recorded(1.5)).toMatchObject({ sound: false });

  await voice.check();
  await page.getByText('can hear you').waitFor();
  await studio.keep('voice-sent');
  // It says "a" half of the time; a machine that is too busy for its microphone hears less.
  await eventually('a recording has the voice', async () => {
    const { id, sound } = await recorded(6);
    expect(sound).toBe(true);
    const opus = Buffer.from(await (await fetch(`${server.url}/v1/recordings/${id as string}/content?format=opus`)).arrayBuffer());
    const { seconds, loud } = await page.evaluate(async (base64) => {
      const content = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const samples = (await new AudioContext({ sampleRate: 48_000 }).decodeAudioData(content.buffer)).getChannelData(0);
      const parts: number[] = [];
      for (let n = 0; n + 2400 <= samples.length; n += 2400) parts.push(Math.hypot(...samples.subarray(n, n + 2400)) / Math.sqrt(2400));
      return { seconds: samples.length / 48_000, loud: parts.filter((level) => level > 0.02).length / parts.length };
    }, opus.toString('base64'));
    console.info(`recorded voice: ${seconds.toFixed(2)} s, loud for ${loud.toFixed(2)} of it`);
    expect(loud).toBeLessThan(0.75);
    return seconds > 2 && loud > 0.1;
  });

  // Whoever begins again is not heard unasked.
  await page.getByRole('button', { name: 'Stop the microphone' }).click();
  await microphone.click();
  await page.getByText('The sound stays on this page.').waitFor();
  expect(await voice.isChecked()).toBe(false);
  expect(studio.errors).toEqual([]);
});

test('Voice_OfABrowserThatCannotEncode_IsSaidInWords', async () => {
  studio = await open();
  const { page } = studio;
  await page.addInitScript(() => Reflect.deleteProperty(globalThis, 'AudioEncoder'));
  await page.reload();
  await studio.waitForStage('ready');
  await studio.context.grantPermissions(['microphone'], { origin: server.url });
  await page.getByRole('button', { name: 'Use the microphone' }).click();
  await page.getByText('This browser cannot send the voice').waitFor();
  expect(await page.getByRole('switch', { name: 'Send my voice too' }).count()).toBe(0);
  expect(studio.errors).toEqual([]);
});
