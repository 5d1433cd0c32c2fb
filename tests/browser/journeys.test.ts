import { readFileSync } from 'node:fs';
import type { Browser, Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { quickSet } from '@protocol/generated/mpeg4.ts';
import { sampleHead, samplePoints } from './support/paths.ts';
import { startServer, type RunningServer } from './support/server.ts';
import { launch, StudioPage, type Inside } from './support/studio_page.ts';

let server: RunningServer;
let browser: Browser;
const known = (
  JSON.parse(readFileSync(samplePoints, 'utf8')) as { points: Record<string, { position: [number, number, number] }> }
).points;
/** The region of the face in the picture. */
const face = [0.3, 0.25, 0.4, 0.5] as const;

beforeAll(async () => {
  [server, browser] = await Promise.all([startServer(), launch()]);
});

afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

/** Presses Tab until a control that matches has the focus; backwards with `back`. */
async function tabTo(page: Page, selector: string, back = false): Promise<void> {
  const there = (): Promise<boolean> => page.evaluate((wanted) => document.activeElement?.matches(wanted) ?? false, selector);
  for (let presses = 0; presses < 60; presses += 1) {
    if (await there()) return;
    await page.keyboard.press(back ? 'Shift+Tab' : 'Tab');
  }
  throw new Error(`no Tab leads to ${selector}`);
}

/** Moves the head by the arrow keys until a place of it is under the cross in the middle of the picture. */
async function bringUnderCross(studio: StudioPage, position: readonly number[]): Promise<void> {
  const { page } = studio;
  const box = (await page.locator('canvas.canvas').boundingBox())!;
  const step = box.height * 0.05;
  const spot = await studio.project(position);
  const right = Math.round((spot.x - box.x - box.width / 2) / step);
  const down = Math.round((spot.y - box.y - box.height / 2) / step);
  for (let i = 0; i < Math.abs(right); i += 1) await page.keyboard.press(right > 0 ? 'Shift+ArrowRight' : 'Shift+ArrowLeft');
  for (let i = 0; i < Math.abs(down); i += 1) await page.keyboard.press(down > 0 ? 'Shift+ArrowDown' : 'Shift+ArrowUp');
}

const chosenPoint = (page: Page): Promise<string> => page.locator('.point-card code.id').innerText();
const count = (page: Page): Promise<number> => page.locator('.point-row.placed, .point-row.changed').count();

async function talks(studio: StudioPage): Promise<void> {
  await studio.waitForState('parametrized');
  await studio.waitForStage('ready');
  await studio.page.waitForFunction(() => (window as unknown as Inside).semblante.driver.source.value === 'stream');
  await studio.pictureUnlike(await studio.picture(), face, 0.3);
}

describe('from a bare avatar to a talking face and a recording', () => {
  test('Keyboard_Alone_LeadsToATalkingFaceAndARecording', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/fit`, { width: 1100, height: 640 });
    const { page } = studio;
    await studio.waitForStage('ready');
    const chooser = page.waitForEvent('filechooser');
    await tabTo(page, 'button.drop');
    await page.keyboard.press('Enter');
    await (await chooser).setFiles(sampleHead);
    await studio.waitForState('ready');
    await studio.waitForStage('ready');
    await tabTo(page, '[role=tab][aria-selected=true]');
    while (!(await page.locator('#tab-points[aria-selected=true]').count())) await page.keyboard.press('ArrowRight');
    await page.waitForFunction(() => document.title.includes('Points'));
    await tabTo(page, '.point-card button');
    await page.keyboard.press('Enter');
    await tabTo(page, 'canvas.canvas', true);
    for (let i = 0; i < 9; i += 1) await page.keyboard.press('+');
    const marked = new Set<string>();
    for (let id = await chosenPoint(page); !marked.has(id); id = await chosenPoint(page)) {
      marked.add(id);
      await bringUnderCross(studio, known[id]!.position);
      await page.keyboard.press('Space');
      if (marked.size === quickSet.length) break;
    }
    expect(await count(page)).toBe(quickSet.length);
    await tabTo(page, '.proposals button');
    await page.keyboard.press('Enter');
    await page.getByRole('button', { name: 'Confirm all' }).waitFor();
    await tabTo(page, '.proposals button:nth-of-type(2)');
    await page.keyboard.press('Enter');
    await tabTo(page, '.points .panel-foot button.primary');
    await page.keyboard.press('Enter');
    await talks(studio);

    await tabTo(page, '[role=tab][aria-selected=true]');
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction(() => document.title.includes('Live'));
    await page.locator('button.record:enabled').waitFor();
    await tabTo(page, 'button.record');
    await page.keyboard.press('Enter');
    await page.getByRole('button', { name: /^Stop recording/ }).waitFor();
    await page.keyboard.press('Enter'); // the focus is on it
    await page.locator('.recording').first().waitFor();
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Touch_At390Pixels_InPortuguese_LeadsToATalkingFaceAndARecording', async () => {
    const context = await browser.newContext({
      viewport: { width: 390, height: 844 },
      hasTouch: true,
      isMobile: true,
      locale: 'pt-BR',
      reducedMotion: 'reduce',
    });
    const studio = await StudioPage.openIn(context, `${server.url}/#sample/fit`);
    const { page } = studio;
    await studio.waitForStage('ready');
    let taps = 0;
    const tap = async (selector: string): Promise<void> => {
      taps += 1;
      await page.locator(selector).first().tap();
    };
    await tap('#tab-heads');
    const chooser = page.waitForEvent('filechooser');
    await tap('button.drop');
    await (await chooser).setFiles(sampleHead);
    await studio.waitForState('ready');
    await studio.waitForStage('ready');
    if (!(await page.locator('#tab-points[aria-selected=true]').count())) await tap('#tab-points');
    await tap('.point-card button');
    for (const [i, id] of quickSet.entries()) {
      expect(await chosenPoint(page)).toBe(id);
      const spot = await studio.project(known[id]!.position);
      taps += 1;
      await page.touchscreen.tap(spot.x, spot.y);
      if (i + 1 < quickSet.length) await page.waitForFunction((next) => document.querySelector('.point-card code.id')?.textContent === next, quickSet[i + 1]);
    }
    expect(await count(page)).toBe(quickSet.length);
    await tap('.proposals button');
    await page.getByRole('button', { name: 'Confirmar todos' }).waitFor();
    await tap('.proposals button:nth-of-type(2)');
    await tap('.points .panel-foot button.primary');
    await talks(studio);
    await studio.keep('touch-talking');

    await tap('#tab-live');
    await page.locator('button.record:enabled').waitFor();
    await tap('button.record');
    await page.getByRole('button', { name: /^Parar de gravar/ }).waitFor();
    await tap('.recorder button');
    await page.locator('.recording').first().waitFor();
    console.log(`a bare avatar talks and is recorded after ${taps} taps, ${quickSet.length} of them on the head`);
    expect(taps).toBeLessThanOrEqual(quickSet.length + 13);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});
