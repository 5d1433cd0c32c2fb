// Captions in a real browser: the page of a stream, the element, and the studio. The words are compared with the sound that the
// audio graph was told to play.
import { mkdirSync } from 'node:fs';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { afterEach, expect, test } from 'vitest';
import { untilFace } from './support/face_page.ts';
import { writesPictures } from './support/looks.ts';
import { closeUsedPages } from './support/page_rest.ts';
import { eventually, patience } from './support/patience.ts';
import { buildDir, root } from './support/paths.ts';
import { leaveOutDraws, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

/** The voice of tones says each word in a row of tones, with 150 ms of silence after each. An emoji is for the face, not for the words. */
const text = 'Mamma mia! 😀 Bom dia a todos. Papa!';
const cues = ['Mamma mia!', 'Bom dia a todos.', 'Papa!'];
/** Pixels of the picture for each of the page, along a side: what is compared are times, and there is no graphics card. */
const deviceScaleFactor = 0.25;
/** ms by which a word and its sound may differ; a display frame is added to it. */
const tolerance = 60;

useStudio({ demo: false, voice: join(root, 'server/voice/examples/beeps.py') }, ['--autoplay-policy=no-user-gesture-required']);
afterEach(async () => {
  await ask('DELETE', '/v1/streams/talk');
  await closeUsedPages(browser);
});

const ask = (method: string, path: string, body?: object): Promise<Response> =>
  fetch(server.url + path, { method, ...(body ? { headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) } : {}) });
const createStream = async (): Promise<void> => expect((await ask('POST', '/v1/streams', { name: 'talk', model: 'sample' })).status).toBe(201);
/** On a small server one voice speaks at a time, perhaps still that of the test before (429); and the text before may just end (409). */
const say = (words: string): Promise<void> =>
  eventually('the stream speaks', async () => {
    const { status } = await ask('POST', '/v1/streams/talk/speech', { text: words, language: 'en' });
    expect([202, 409, 429]).toContain(status);
    return status === 202;
  });

/** What a page shows and lets hear. Times in ms of its audio clock, as they leave the loudspeaker. */
interface Seen {
  /** Each change of the words, with the display frame before it. */
  changes: { text: string; at: number; before: number }[];
  /** Loudness of each 5 ms of the sound that was played. */
  sound: { at: number; loudness: number }[];
}

/** Runs in the page before its scripts. */
function watch(): void {
  const seen: Seen = { changes: [], sound: [] };
  let context: AudioContext | null = null;
  const Context = globalThis.AudioContext;
  globalThis.AudioContext = class extends Context {
    constructor(options?: AudioContextOptions) {
      super(options);
      context = this;
    }
  };
  const start = AudioBufferSourceNode.prototype.start;
  AudioBufferSourceNode.prototype.start = function (at = 0) {
    start.call(this, at);
    const samples = this.buffer!.getChannelData(0);
    const step = this.buffer!.sampleRate / 200;
    for (let n = 0; n + step <= samples.length; n += step)
      seen.sound.push({ at: 1000 * at + n / (step / 5), loudness: Math.hypot(...samples.subarray(n, n + step)) / Math.sqrt(step) });
  };
  const now = (): number => (context ? 1000 * (context.currentTime - (context.outputLatency || context.baseLatency || 0)) : NaN);
  const captions = (): Element | null =>
    document.querySelector('semblante-face')?.shadowRoot?.querySelector('.captions') ?? document.querySelector('.live-captions > .captions');
  let last = '';
  let before = NaN;
  const look = (): void => {
    const words = captions()?.textContent ?? '';
    if (words !== last) seen.changes.push({ text: words, at: now(), before });
    last = words;
  };
  const watched = new WeakSet<Node>();
  const frame = (): void => {
    const box = captions();
    if (box && !watched.has(box)) {
      watched.add(box);
      new MutationObserver(look).observe(box, { subtree: true, childList: true, characterData: true });
    }
    look();
    before = now();
    requestAnimationFrame(frame);
  };
  requestAnimationFrame(frame);
  Object.assign(window, { seen });
}

const seenIn = (page: Page): Promise<Seen> => page.evaluate(() => (window as unknown as { seen: Seen }).seen);

/** Where tones begin after silence: one for each word. */
function onsets(sound: Seen['sound']): number[] {
  const found: number[] = [];
  let loudUntil = -Infinity;
  for (const { at, loudness } of sound) {
    if (loudness < 0.03) continue;
    if (at - loudUntil > 80) found.push(at);
    loudUntil = at;
  }
  return found;
}

/** Until a text is heard: a busy machine may lose all sound of one, most likely of the first. */
async function untilHeard(page: Page): Promise<void> {
  await eventually('sound is heard', async () => {
    await say('Mamma mia mamma mia.');
    await eventually('the first text is over', async () => ((await (await ask('GET', '/v1/streams/talk')).json()) as { playing: unknown }).playing === null);
    await eventually('its words have gone', async () => ((await seenIn(page)).changes.at(-1)?.text ?? '') === '');
    return (await seenIn(page)).sound.some(({ loudness }) => loudness > 0.03);
  });
}

/** Says the text, waits until its words have come and gone in order, and tells for each cue how long after the sound of its first word it came. */
async function expectWords(page: Page, picture: string): Promise<{ after: number; frame: number }[]> {
  await page.evaluate(() => Object.values((window as unknown as { seen: Seen }).seen).forEach((list: unknown[]) => (list.length = 0)));
  await say(text);
  await eventually('the second cue is shown', async () => (await seenIn(page)).changes.some(({ text: shown }) => shown === cues[1]));
  await keep(page, picture);
  await eventually('the words have gone', async () => {
    const { changes } = await seenIn(page);
    return changes.some(({ text: words }) => words === cues.at(-1)) && changes.at(-1)!.text === '';
  });
  const { changes, sound } = await seenIn(page);
  const words = changes.filter(({ text: shown }) => shown !== '');
  expect(words.map(({ text: shown }) => shown)).toEqual(cues);
  const starts = onsets(sound);
  const late = words.map(({ at, before }) => {
    const heard = starts.reduce((best, one) => (Math.abs(one - at) < Math.abs(best - at) ? one : best), starts[0] ?? NaN);
    return { after: at - heard, frame: at - before };
  });
  const figures = late.map(({ after, frame }) => `${after.toFixed(0)} (frame of ${frame.toFixed(0)})`).join(', ');
  console.info(`${picture}: words after their sound, ms: ${figures}`);
  return late;
}

const isInStep = ({ after, frame }: { after: number; frame: number }): boolean => after > -tolerance && after - frame < tolerance;

async function keep(page: Page, name: string): Promise<void> {
  if (!writesPictures) return;
  const folder = join(buildDir, 'screenshots');
  mkdirSync(folder, { recursive: true });
  await page.screenshot({ path: join(folder, `${name}.png`) });
}

test('PageOfAStream_CaptionsButton_ShowsWordsInStepWithTheSound_AndIsRemembered', async () => {
  await createStream();
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, deviceScaleFactor });
  if (!writesPictures) await leaveOutDraws(context);
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  const hellos: Buffer[] = [];
  page.on('websocket', (socket) => socket.on('framesent', ({ payload }) => void hellos.push(Buffer.from(payload))));
  await page.addInitScript(watch);
  await page.goto(`${server.url}/view/talk`, { waitUntil: 'domcontentloaded' });
  await untilFace(page, 'playing');
  await page.getByRole('button', { name: 'Sound on' }).click();
  await page.getByRole('button', { name: 'Sound off' }).waitFor();
  const button = page.getByRole('button', { name: 'Captions' });
  expect(await button.getAttribute('aria-pressed')).toBe('false');
  await button.click();
  expect(await button.getAttribute('aria-pressed')).toBe('true');
  await untilHeard(page);
  // A busy machine loses packets of sound, and with them beginnings of words.
  await eventually('words come with their sound', async () => (await expectWords(page, 'captions-view-phone')).filter(isInStep).length >= cues.length - 1);
  const box = await page.locator('semblante-face .captions > span').evaluate((span) => {
    span.textContent = 'Words';
    const { left, right, bottom } = span.getBoundingClientRect();
    return { left, right, bottom, corner: document.querySelector('.corner')!.getBoundingClientRect().top };
  });
  expect(box.left).toBeGreaterThanOrEqual(0);
  expect(box.right).toBeLessThanOrEqual(390);
  expect(box.bottom, 'above the buttons').toBeLessThanOrEqual(box.corner);

  // Another page of this browser has them at once, as an element that the page writes has them by its attribute.
  await page.reload({ waitUntil: 'domcontentloaded' });
  await untilFace(page, 'playing');
  expect(await button.getAttribute('aria-pressed')).toBe('true');
  await say('Papa!');
  await page.waitForFunction(() => document.querySelector('semblante-face')!.shadowRoot!.querySelector('.captions')!.textContent === 'Papa!');
  // The next element would show these words as well if it came before their end.
  await page.waitForFunction(() => document.querySelector('semblante-face')!.shadowRoot!.querySelector('.captions')!.textContent === '');
  await button.click();
  expect(await page.evaluate(() => localStorage.getItem('semblante.captions'))).toBe('off');

  const cuesTold = await page.evaluate(() => {
    document.querySelector('main')!.innerHTML = '<semblante-face stream="talk" captions style="width: 320px; height: 320px"></semblante-face>';
    const told: { text: string; language: string }[] = [];
    document.querySelector('semblante-face')!.addEventListener('cuechange', (event) => told.push((event as CustomEvent<{ text: string; language: string }>).detail));
    Object.assign(window, { told });
    return told.length;
  });
  expect(cuesTold).toBe(0);
  await page.waitForFunction(() => (document.querySelector('semblante-face') as unknown as { state: string }).state === 'playing');
  const greeting = 'Bom dia a todas as pessoas desta casa!'; // one cue, longer than the time between two pictures of a busy machine
  await say(greeting);
  await page.waitForFunction(() => (window as unknown as { told: object[] }).told.length === 2);
  expect(await page.evaluate(() => (window as unknown as { told: object[] }).told)).toEqual([{ text: greeting, language: 'en' }, { text: '', language: '' }]);
});

test('Studio_SwitchInLive_ShowsWords_AndIsRemembered', async () => {
  await createStream();
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 }, reducedMotion: 'reduce', deviceScaleFactor });
  await context.addInitScript(watch);
  const studio = await StudioPage.openIn(context, `${server.url}/#sample/live?stream=talk`, { seen: writesPictures });
  const { page } = studio;
  await studio.waitForStage('ready');
  const captions = page.getByRole('switch', { name: 'Captions' });
  expect(await captions.isChecked()).toBe(false);
  await captions.check();
  await page.getByRole('switch', { name: /^Sound/ }).check();
  const between = await page.locator('.live-captions .captions > span').evaluate((span) => {
    span.textContent = 'Words';
    const { bottom } = span.getBoundingClientRect();
    span.textContent = '';
    return document.querySelector('.tools')!.getBoundingClientRect().top - bottom;
  });
  expect(between, 'above the buttons').toBeGreaterThanOrEqual(0);
  await untilHeard(page);
  await expectWords(page, 'captions-studio'); // a busy machine draws the studio too slowly for a comparison of times
  await page.reload();
  await studio.waitForStage('ready');
  expect(await captions.isChecked()).toBe(true);
  expect(studio.errors).toEqual([]);
});
