import { join } from 'node:path';
import type { CDPSession } from 'playwright-core';
import { expect, test } from 'vitest';
import { root } from './support/paths.ts';
import { coarse, StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

/**
 * Bytes of a drawn frame that the studio's own code may allocate between the browser's call and its return, three.js apart: numbers
 * that code which is not yet optimized keeps on the heap, 12 bytes each. A frame of a face has 400, its pose 2800.
 */
const mostBytes = 650;
const frames = 160;

useStudio({ lively: true });

interface Sampled {
  callFrame: { functionName: string; url: string };
  selfSize: number;
  children: Sampled[];
}

/** Bytes that the studio's scripts allocated below its frame loop. A function of the browser counts for the script that called it. */
function inTheLoop({ children, selfSize, callFrame: { functionName, url } }: Sampled, isOurs = false, inLoop = false): number {
  const ours = url === '' ? isOurs : !/\/three-[^/]*\.js$/.test(url);
  const looping = inLoop || (ours && functionName === 'frame');
  return (ours && looping ? selfSize : 0) + children.reduce((sum, child) => sum + inTheLoop(child, ours, looping), 0);
}

/** Bytes a drawn frame; whether the collector ran does not matter. */
async function bytesOfFrames(studio: StudioPage, devtools: CDPSession): Promise<number> {
  const drawn = (): Promise<number> => studio.page.evaluate(() => (window as unknown as Inside).semblante.scene.stage.drawn);
  const before = await drawn();
  const options = { samplingInterval: 256, includeObjectsCollectedByMajorGC: true, includeObjectsCollectedByMinorGC: true };
  await devtools.send('HeapProfiler.startSampling', options);
  await studio.drawn(frames);
  const { profile } = await devtools.send('HeapProfiler.stopSampling');
  const count = (await drawn()) - before;
  expect(count, 'the face moves in each frame').toBeGreaterThan(frames / 2);
  return inTheLoop(profile.head) / count;
}

/** Of code that is optimized: on a busy machine the browser does that late. What each frame allocates is there every time. */
async function bytesOfAFrame(studio: StudioPage, devtools: CDPSession): Promise<number> {
  await studio.drawn(frames / 2);
  let least = Infinity;
  for (let i = 0; i < 4 && least >= mostBytes; i += 1) least = Math.min(least, await bytesOfFrames(studio, devtools));
  return least;
}

test('FrameLoop_StreamDocumentFileAndIdleLife_AllocatesNothing', async () => {
  const context = await browser.newContext({ viewport: { width: 360, height: 320 }, deviceScaleFactor: coarse, reducedMotion: 'reduce', serviceWorkers: 'block' });
  const studio = await StudioPage.openIn(context, server.url, { seen: false }); // the graphics card's part is not looked at
  const { page } = studio;
  const devtools = await context.newCDPSession(page);
  await studio.waitForStage('ready');
  await page.locator('#tab-animate').click();
  const driver = page.locator('.driver');
  const measured: Record<string, number> = {};

  await driver.getByText(/^Live: /).waitFor();
  measured['stream'] = await bytesOfAFrame(studio, devtools);
  await studio.drop(join(root, 'protocol/examples/performances/minute.json'));
  await driver.getByText('Playing minute.json').waitFor();
  measured['document'] = await bytesOfAFrame(studio, devtools);
  const mask = Array.from({ length: 68 }, (_, fap) => ([2, 47].includes(fap) ? 1 : 0)).join(' ');
  const lines = Array.from({ length: 100 }, (_, i) => `${mask}\n${i} ${i * 12} ${i * 5}`);
  await studio.dropText('file.fap', `2.1 file 1 100\n${lines.join('\n')}\n`);
  await driver.getByText('Playing file.fap').waitFor();
  measured['file'] = await bytesOfAFrame(studio, devtools);
  await page.locator('#idle-life').check();
  await driver.getByText('By hand').waitFor();
  measured['idle life'] = await bytesOfAFrame(studio, devtools);

  console.info(`bytes a frame: ${JSON.stringify(measured)}`);
  for (const [what, bytes] of Object.entries(measured)) expect(bytes, what).toBeLessThan(mostBytes);
  expect(studio.errors).toEqual([]);
  await studio.close();
});
