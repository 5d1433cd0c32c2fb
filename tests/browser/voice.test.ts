import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { afterEach, expect, test } from 'vitest';
import { untilFace } from './support/face_page.ts';
import { closeUsedPages } from './support/page_rest.ts';
import { patience } from './support/patience.ts';
import { root } from './support/paths.ts';
import { coarse, leaveOutDraws } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

/** The page of a stream whose text the browser's own voice says. The server's voice, of tones, gives the times. */
useStudio({ demo: false, voice: join(root, 'server/voice/examples/beeps.py') });

interface Inside {
  said: { text: string; lang: string; at: number }[];
  semblanteFace: { show: { kernel: { poses: { featurePoints: Float32Array }[] } } };
}

/**
 * In place of the browser's voice, of which a headless one has none: says 15 letters a second, tells each word, and makes no sound.
 * `dumb`: it takes texts and does nothing.
 */
function voice({ language, dumb }: { language: string; dumb: boolean }): void {
  const said: Inside['said'] = [];
  let running = 0;
  class Utterance {
    voice = null;
    lang = '';
    rate = 1;
    onstart?: () => void;
    onend?: () => void;
    onboundary?: (event: object) => void;
    constructor(readonly text: string) {}
  }
  const synthesis = {
    getVoices: () => [{ lang: language, name: 'Test', voiceURI: 'test', default: true, localService: true }],
    addEventListener: () => undefined,
    cancel: () => (running += 1),
    speak(utterance: Utterance) {
      said.push({ text: utterance.text, lang: utterance.lang, at: performance.now() });
      if (dumb) return;
      const turn = (running += 1);
      const later = (ms: number, call: () => void): unknown => setTimeout(() => turn === running && call(), ms);
      later(80, () => utterance.onstart?.());
      for (const { index } of utterance.text.matchAll(/\S+/g)) later(85 + index * 66, () => utterance.onboundary?.({ name: 'word', charIndex: index }));
      later(100 + utterance.text.length * 66, () => utterance.onend?.());
    },
  };
  Object.defineProperty(window, 'speechSynthesis', { value: synthesis });
  Object.assign(window, { SpeechSynthesisUtterance: Utterance, said });
}

const ask = (method: string, path: string, body?: object): Promise<Response> =>
  fetch(server.url + path, {
    method,
    ...(body ? { headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) } : {}),
  });

/** The page of the stream "talk" with such a voice, or with none; and how many messages of each type it got. */
async function open(given: { language: string; dumb: boolean } | null): Promise<{ page: Page; got: (type: number) => number; sent: (type: number) => number; bytes: () => number }> {
  expect((await ask('POST', '/v1/streams', { name: 'talk', model: 'sample' })).status).toBe(201);
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, deviceScaleFactor: coarse });
  await leaveOutDraws(context);
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  if (given) await page.addInitScript(voice, given);
  else await page.addInitScript(() => Object.defineProperty(window, 'speechSynthesis', { value: undefined }));
  const received: Uint8Array[] = [];
  const written: Uint8Array[] = [];
  page.on('websocket', (socket) => {
    socket.on('framereceived', ({ payload }) => received.push(Buffer.from(payload)));
    socket.on('framesent', ({ payload }) => written.push(Buffer.from(payload)));
  });
  await page.goto(`${server.url}/view/talk?voice`, { waitUntil: 'domcontentloaded', timeout: patience });
  await untilFace(page, 'resting', 'playing');
  const count = (of: Uint8Array[]) => (type: number) => of.filter(([first]) => (type === 128 ? first! >= 128 : first === type)).length;
  return { page, got: count(received), sent: count(written), bytes: () => received.reduce((sum, { length }) => sum + length, 0) };
}

const say = (text: string): Promise<Response> => ask('POST', '/v1/streams/talk/speech', { text, language: 'en', seed: 7 });

afterEach(async () => {
  await ask('DELETE', '/v1/streams/talk');
  await closeUsedPages(browser);
});

test('BrowsersVoice_SaysTheText_AndTheFaceSpeaksWithoutFrames', async () => {
  const { page, got, sent } = await open({ language: 'en-GB', dumb: false });
  const button = page.locator('semblante-face').getByRole('button', { name: 'Voice on' });
  await button.click();
  await page.locator('semblante-face').getByRole('button', { name: 'Voice off' }).waitFor();
  const frames = got(128);
  expect((await say('Good morning to all of you. This is a wide open mouth, mama!')).status).toBe(202);
  await page.waitForFunction(() => (window as unknown as Inside).said.length === 1);
  // The face moves while the first text is said.
  const poses = await page.evaluate(async () => {
    const inside = window as unknown as Inside;
    const seen = new Set<string>();
    while (inside.said.length < 2) {
      seen.add(Array.from(inside.semblanteFace.show.kernel.poses[0]!.featurePoints).join());
      await new Promise(requestAnimationFrame);
    }
    return seen.size;
  });
  expect(poses).toBeGreaterThan(3);
  const said = await page.evaluate(() => (window as unknown as Inside).said);
  expect(said.map(({ text, lang }) => [text, lang])).toEqual([
    ['Good morning to all of you.', 'en-GB'],
    ['This is a wide open mouth, mama!', 'en-GB'],
  ]);
  expect(got(128)).toBe(frames);
  expect(got(13)).toBe(2);
  expect(got(10)).toBe(0);
  expect(sent(12)).toBeGreaterThanOrEqual(3); // ready, a word, the end of the first text
});

test('BrowsersVoice_IsSilenced_WhenTheSpeechIsStopped', async () => {
  const { page, got } = await open({ language: 'en-GB', dumb: false });
  await page.locator('semblante-face').getByRole('button', { name: 'Voice on' }).click();
  const { id } = (await (await say('One. Two and three and four and five. Six.')).json()) as { id: string };
  await page.waitForFunction(() => (window as unknown as Inside).said.length >= 1);
  expect((await ask('DELETE', `/v1/streams/talk/performances/${id}`)).status).toBeLessThan(300);
  await expect.poll(() => got(9), { timeout: patience }).toBeGreaterThan(1);
  const said = await page.evaluate(() => (window as unknown as Inside).said.length);
  await page.waitForTimeout(1500);
  expect(await page.evaluate(() => (window as unknown as Inside).said.length)).toBe(said);
});

test.each([
  ['of another language', { language: 'pt-BR', dumb: false }, 0],
  ['that does not speak', { language: 'en-GB', dumb: true }, 1],
])('BrowsersVoice_%s_GivesWayToFramesAndSound', async (_, given, texts) => {
  const { page, got, sent } = await open(given);
  await page.locator('semblante-face').getByRole('button', { name: 'Voice on' }).click();
  await page.locator('semblante-face').getByRole('button', { name: 'Voice off' }).waitFor();
  await say('This is a long sentence that goes on for some time, so that there is enough of it when the voice has failed, and then some more of it comes.');
  await expect.poll(() => sent(12), { timeout: patience }).toBe(2); // ready, failed
  const frames = got(128);
  await expect.poll(() => got(128), { timeout: patience }).toBeGreaterThan(frames + 5);
  expect(await page.evaluate(() => (window as unknown as Inside).said.length)).toBe(texts);
  await page.locator('semblante-face').getByRole('button', { name: /Sound on|No sound/ }).waitFor();
});

test('BrowserWithoutVoices_ShowsTheFramesAsBefore', async () => {
  const { page, got, sent } = await open(null);
  expect(await page.locator('semblante-face').getByRole('button', { name: /Voice/ }).count()).toBe(0);
  await say('Good morning to all of you.');
  await expect.poll(() => got(128), { timeout: patience }).toBeGreaterThan(5);
  expect(got(13)).toBe(0);
  expect(sent(12)).toBe(0);
});
