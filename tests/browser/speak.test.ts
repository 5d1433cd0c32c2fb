import { join } from 'node:path';
import { afterAll, afterEach, beforeAll, expect, test } from 'vitest';
import { root } from './support/paths.ts';
import { startServer, type RunningServer } from './support/server.ts';
import { StudioPage, type OpenOptions } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

/** A voice of tones: the same sound and times everywhere. */
const beeps = join(root, 'server/voice/examples/beeps.py');

let mute: RunningServer;
let studio: StudioPage;

useStudio({ demo: false, voice: beeps });
beforeAll(async () => {
  mute = await startServer({ demo: false });
});
afterEach(async () => studio?.close());
afterAll(() => mute?.stop());

interface Inside {
  semblante: {
    scene: {
      performer: { value: { poseNumber: number; kernel: { positions: Float32Array; deform(pose: number): void } } };
      face: { mesh: { positions: Float32Array } };
      rig: { feature_points: { id: string; vertex: number }[] };
    };
  };
}

/**
 * The opening of the mouth at a time of the sound: how far 2.3 is below 2.2, beyond its place at rest; model units. The sound
 * is paused there, so that the result does not depend on how busy the machine is.
 */
async function openingAt(page: StudioPage, ms: number): Promise<number> {
  await page.page.evaluate((time) => {
    const audio = (window as unknown as { speakSound: HTMLAudioElement }).speakSound;
    audio.pause();
    audio.currentTime = time / 1000;
  }, ms);
  await page.drawn(4);
  return page.page.evaluate(() => {
    const { performer, face, rig } = (window as unknown as Inside).semblante.scene;
    const { kernel, poseNumber } = performer.value;
    kernel.deform(poseNumber);
    const [upper, lower] = ['2.2', '2.3'].map((wanted) => rig.feature_points.find(({ id }) => id === wanted)!.vertex * 3 + 1);
    const between = (positions: Float32Array): number => positions[upper!]! - positions[lower!]!;
    return between(kernel.positions) - between(face.mesh.positions);
  });
}

/** On a small server one voice speaks at a time: the page waits, after 429, while that of the test before still makes its text. */
async function open(url: string, options: OpenOptions = { allowed: /status of 429/ }): Promise<StudioPage> {
  const page = await StudioPage.open(browser, url, options);
  await page.waitForStage('ready');
  await page.page.getByRole('tab', { name: 'Animate' }).click();
  return page;
}

test('Speak_Text_IsHeardSeenAndFollowed_AndTheMouthClosesAtAP', async () => {
  studio = await open(server.url);
  const { page } = studio;
  // The slowest that browsers play, so that a busy machine sees a word while it is said.
  await page.evaluate(() => {
    const audio = (window as unknown as { semblante: { sound: HTMLAudioElement } }).semblante.sound;
    Object.assign(window, { speakSound: audio });
    audio.defaultPlaybackRate = audio.playbackRate = 0.0625;
  });
  await page.getByRole('textbox', { name: 'Text to say' }).fill('apa upa');
  await page.getByRole('button', { name: 'Speak', exact: true }).click();
  await page.locator('.driver').getByText('Speaking').waitFor();
  await page.locator('.said-word.now').first().waitFor();
  expect(await page.locator('.said-words').textContent()).toBe('apa upa');
  const id = await page
    .locator('.speak-files a')
    .first()
    .getAttribute('href')
    .then((href) => /speeches\/(\w+)\/audio/.exec(href!)![1]);
  const timeline = (await (await fetch(`${server.url}/v1/speeches/${id}/timeline`)).json()) as {
    phonemes: { time: number; end: number; ipa: string }[];
  };
  await page.getByRole('button', { name: 'Stop' }).click();
  await page.locator('.driver').getByText('By hand').waitFor();
  await page.getByRole('button', { name: 'Again' }).click();
  await page.locator('.driver').getByText('Speaking').waitFor();
  const middle = (ipa: string): number => {
    const phoneme = timeline.phonemes.find((p) => p.ipa === ipa)!;
    return (phoneme.time + phoneme.end) / 2;
  };
  const [open1, closed] = [await openingAt(studio, middle('a')), await openingAt(studio, middle('p'))];
  expect(open1).toBeGreaterThan(0);
  expect(closed).toBeLessThan(0.15 * open1);
  expect(studio.errors).toEqual([]);

  // Another source takes the face: it falls silent.
  await page.evaluate(() => (window as unknown as { speakSound: HTMLAudioElement }).speakSound.play());
  await page.getByLabel('Strength').first().fill('50');
  await page.locator('.driver').getByText('By hand').waitFor();
  expect(await page.evaluate(() => (window as unknown as { speakSound: HTMLAudioElement }).speakSound.paused)).toBe(true);
});

test('Speak_LongText_BeginsWithItsFirstSentence_AndGoesOnToItsEnd', async () => {
  studio = await open(server.url);
  const { page } = studio;
  // The fastest that browsers play: the text takes half a minute.
  await page.evaluate(() => {
    const audio = (window as unknown as { semblante: { sound: HTMLAudioElement } }).semblante.sound;
    const heard: string[] = [];
    audio.addEventListener('playing', () => heard.push(audio.src));
    Object.assign(window, { speakSound: audio, heard });
    audio.defaultPlaybackRate = audio.playbackRate = 16;
  });
  const first = 'uma primeira frase que dura o bastante para si.';
  const text = `${first} ${'e outra que vem depois. '.repeat(12)}`;
  await page.getByRole('textbox', { name: 'Text to say' }).fill(text);
  await page.getByRole('textbox', { name: 'Text to say' }).press('Enter');
  // The words of the whole are shown as soon as it is made; the voice goes on in it.
  await page.locator('.said-words').getByText('depois').first().waitFor();
  await page.waitForFunction(() => {
    const { heard } = window as unknown as { heard: string[] };
    return new Set(heard).size === 2;
  });
  expect(await page.locator('.said-words').textContent()).toBe(text.trim());
  await page.locator('.driver').getByText('By hand').waitFor();
  const duration = await page.evaluate(() => (window as unknown as { speakSound: HTMLAudioElement }).speakSound.duration);
  expect(duration).toBeGreaterThan(20);
  const left = (await (await fetch(`${server.url}/v1/speeches`)).json()) as { speeches: { rest: string }[] };
  expect(left.speeches.filter(({ rest }) => rest !== '')).toEqual([]);
  expect(studio.errors).toEqual([]);
});

test('Speak_Voices_AreThoseOfTheLanguage', async () => {
  studio = await open(server.url);
  const { page } = studio;
  await page.getByRole('tabpanel', { name: 'Animate' }).getByLabel('Language').selectOption('en');
  const voice = page.getByRole('tabpanel', { name: 'Animate' }).getByLabel('Voice');
  await voice.getByRole('option', { name: 'Tones' }).waitFor({ state: 'attached' });
  await voice.selectOption('beeps');
  await page.getByRole('textbox', { name: 'Text to say' }).fill('oh');
  const [request] = await Promise.all([
    page.waitForRequest((one) => one.method() === 'POST' && one.url().endsWith('/v1/speeches')),
    page.getByRole('button', { name: 'Speak', exact: true }).click(),
  ]);
  expect(request.postDataJSON()).toMatchObject({ voice: 'beeps', language: 'en' });
  await page.getByRole('tabpanel', { name: 'Animate' }).getByLabel('Language').selectOption('pt-BR');
  expect(await voice.getByRole('option').count()).toBe(1);
  expect(studio.errors).toEqual([]);
});

test('Speak_NextText_LeavesOneSpeechOnTheServer', async () => {
  studio = await open(server.url);
  const { page } = studio;
  for (const text of ['mama', 'papa']) {
    await page.getByRole('textbox', { name: 'Text to say' }).fill(text);
    await page.getByRole('textbox', { name: 'Text to say' }).press('Enter');
    await page.locator('.said-words').getByText(text).waitFor();
  }
  await page.waitForFunction(async () => {
    const answer = (await (await fetch('/v1/speeches')).json()) as { speeches: { text: string }[] };
    return answer.speeches.filter(({ text }) => text === 'mama').length === 0;
  }, undefined, { polling: 200 }); // at each displayed frame it would be too many requests
  expect(studio.errors).toEqual([]);
});

test('Speak_ServerWithoutAVoice_SaysWhatIsMissing', async () => {
  studio = await open(mute.url, { allowed: /501/ });
  const { page } = studio;
  await page.getByRole('button', { name: 'Speak', exact: true }).click();
  await page.getByRole('alert').getByText('no voice is installed').waitFor();
  expect(studio.errors).toEqual([]);
});
