import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { validateBytes } from 'gltf-validator';
import type { Download, Page } from 'playwright-core';
import { describe, expect, test } from 'vitest';
import { buildDir, root } from './support/paths.ts';
import { eventually } from './support/patience.ts';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

const hello = join(root, 'protocol/examples/performances/hello.json');
const voice = join(buildDir, 'bin/semblante-voice-espeak');
useStudio({ demo: false, voice, lively: true });

async function saved(page: Page, act: () => Promise<void>): Promise<{ name: string; bytes: Buffer }> {
  const [download] = await Promise.all([page.waitForEvent('download'), act()]);
  return { name: (download as Download).suggestedFilename(), bytes: readFileSync(await download.path()) };
}

/** Width, height and length of a video, s, and how many of its sampled sounds are not silent. */
function measured(page: Page, bytes: Buffer): Promise<{ width: number; height: number; seconds: number; loud: number }> {
  return page.evaluate(async (base64) => {
    const content = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const video = document.createElement('video');
    video.muted = true;
    video.src = URL.createObjectURL(new Blob([content], { type: 'video/webm' }));
    await new Promise((resolve, reject) => {
      video.onloadeddata = resolve;
      video.onerror = () => reject(new Error(video.error?.message));
    });
    // A recorder cannot write the length in front: seeking beyond the end makes the browser measure it.
    await new Promise((resolve) => {
      video.onseeked = resolve;
      video.currentTime = 1e6;
    });
    const audio = await new AudioContext().decodeAudioData(content.buffer).catch(() => null);
    const loud = audio ? audio.getChannelData(0).filter((value) => Math.abs(value) > 0.01).length : 0;
    return { width: video.videoWidth, height: video.videoHeight, seconds: video.currentTime, loud };
  }, bytes.toString('base64'));
}

/** Time of the last key of a GLB's animation, s. */
function durationOf(glb: Buffer): number {
  const { accessors, animations } = JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString()) as {
    accessors: { max?: number[] }[];
    animations: { samplers: { input: number }[] }[];
  };
  return Math.max(...animations[0]!.samplers.map(({ input }) => accessors[input]!.max![0]!));
}

describe('export', () => {
  test('PictureAndFap_AreWhatIsOnTheStage', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 1440, height: 900 });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.locator('.viseme[data-viseme="10"]').click();
    const picture = await saved(page, () => page.getByRole('button', { name: 'Picture' }).click());
    expect(picture.name).toBe('Sample head.png');
    const { corner, middle } = await page.evaluate(async (base64) => {
      const image = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: 'image/png' }));
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d')!;
      context.drawImage(image, 0, 0);
      const alpha = (x: number, y: number): number => context.getImageData(x, y, 1, 1).data[3]!;
      return { corner: alpha(2, 2), middle: alpha(image.width >> 1, image.height >> 1) };
    }, picture.bytes.toString('base64'));
    expect([corner, middle]).toEqual([0, 255]);

    // One frame by hand; a whole clip once a document plays.
    const hand = await saved(page, () => page.getByRole('button', { name: '.fap', exact: true }).click());
    expect(hand.name).toBe('Sample head.fap');
    expect(hand.bytes.toString().trim().split('\n').length).toBeLessThan(10);
    await studio.drop(hello);
    await page.getByText('hello.json').first().waitFor();
    const clip = await saved(page, () => page.getByRole('button', { name: '.fap', exact: true }).click());
    // It is read and played by this page again, as long as the document.
    expect(clip.bytes.toString().trim().split('\n').length).toBeGreaterThan(100);

    // On the head: the server's clip of the document, read by others without a fault.
    const glb = await saved(page, () => page.getByRole('button', { name: 'GLB clip' }).click());
    expect(glb.name).toBe('Sample head-clip.glb');
    const report = await validateBytes(new Uint8Array(glb.bytes));
    expect(report.issues.messages.filter(({ severity }) => severity <= 1)).toEqual([]);
    expect([report.info.animationCount, report.info.hasSkins]).toEqual([1, true]);
    const document = await saved(page, () => page.getByRole('button', { name: 'Performance', exact: true }).click());
    expect(JSON.parse(document.bytes.toString())).toEqual(JSON.parse(readFileSync(hello, 'utf8')));
    const face = await saved(page, () => page.getByRole('button', { name: 'Face package' }).click());
    expect([face.name, face.bytes.subarray(0, 4).toString()]).toEqual(['Sample head.glb', 'glTF']);
    await studio.keep('export-wide');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Video_OfASpeech_HasPictureAndSoundAndEndsWithIt', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 880, height: 560, sharp: true });
    const { page } = studio;
    await studio.waitForStage('ready');
    const video = page.getByRole('button', { name: 'Video' });
    const { name, bytes } = await saved(page, async () => {
      await video.click();
      await page.getByRole('button', { name: 'Stop and save' }).waitFor();
      await page.getByRole('textbox', { name: 'Text to say' }).fill('Hello there.');
      await page.getByRole('button', { name: 'Speak', exact: true }).click();
    });
    expect(name).toBe('Sample head.webm');
    await video.waitFor();
    const { width, height, seconds, loud } = await measured(page, bytes);
    expect(width).toBeGreaterThan(300);
    expect(height).toBeGreaterThan(300);
    expect(seconds).toBeGreaterThan(0.5);
    expect(loud).toBeGreaterThan(1000);

    // The speech stays what is saved after its end, until the face is changed.
    const clip = await saved(page, () => page.getByRole('button', { name: 'GLB clip' }).click());
    expect(durationOf(clip.bytes)).toBeGreaterThan(0.5);
    await page.locator('.viseme[data-viseme="10"]').click();
    const still = await saved(page, () => page.getByRole('button', { name: 'GLB clip' }).click());
    expect(durationOf(still.bytes)).toBe(0);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Video_OfAFollowedStream_HasItsSound', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 880, height: 560 });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.getByRole('textbox', { name: 'Text to say' }).first().fill('Hello, hello, hello there.');
    const { bytes } = await saved(page, async () => {
      await page.getByRole('button', { name: 'Video' }).click();
      await page.getByRole('button', { name: 'Stop and save' }).waitFor();
      await page.getByRole('button', { name: 'Speak into a stream' }).first().click();
      await page.getByRole('button', { name: 'Show the recording' }).first().waitFor();
      await page.getByRole('button', { name: 'Stop and save' }).click();
    });
    const { width, loud } = await measured(page, bytes);
    expect(width).toBeGreaterThan(100);
    expect(loud).toBeGreaterThan(1000);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Keyboard_Narrow_VideoStartsAndStops', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 390, height: 844, dark: true });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.locator('.viseme[data-viseme="10"]').click();
    await page.getByRole('button', { name: 'Video' }).focus();
    const { bytes } = await saved(page, async () => {
      await page.keyboard.press('Enter');
      await page.getByRole('button', { name: 'Stop and save' }).waitFor();
      await studio.keep('export-narrow');
      await page.locator('.viseme[data-viseme="4"]').press('Enter');
      await studio.drawn(20);
      await page.getByRole('button', { name: 'Stop and save' }).focus();
      await page.keyboard.press('Space');
    });
    await eventually('the button starts again', () => page.getByRole('button', { name: 'Video' }).isVisible());
    expect((await measured(page, bytes)).width).toBeGreaterThan(100);
    const picture = await saved(page, () => page.getByRole('button', { name: 'Picture' }).press('Enter'));
    expect(picture.bytes.subarray(1, 4).toString()).toBe('PNG');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});
