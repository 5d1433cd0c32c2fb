import type { Page } from 'playwright-core';
import { describe, expect, test } from 'vitest';
import { eventually } from './support/patience.ts';
import { StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio();

/** Pixels of the canvas for each of the page, along a side. */
const pixels = (page: Page): Promise<number> =>
  page.locator('canvas.canvas').evaluate((canvas) => (canvas as HTMLCanvasElement).width / canvas.clientWidth);

/** The figures over the picture by their names. */
const figures = (page: Page): Promise<Record<string, string>> =>
  page.locator('.live-overlay dl > div').evaluateAll((rows) =>
    Object.fromEntries(rows.map((row) => [row.querySelector('dt')!.textContent, row.querySelector('dd')!.textContent])),
  );

describe('the figures over the picture', () => {
  test('FollowedStream_FiguresComeAndGoWithTheSwitchAndTheStream', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/live?stream=demo`, { width: 1440, height: 900, sharp: true });
    const { page } = studio;
    await studio.waitForStage('ready');
    const overlay = page.getByRole('group', { name: 'Figures of the stream' });
    expect(await overlay.count()).toBe(0);
    await page.getByText('Figures on the picture').click();
    await overlay.waitFor();
    await eventually('all figures are measured', async () => {
      const { Data, Frames, Buffer, Late } = await figures(page);
      const least = (text: string | undefined, value: number): boolean => parseFloat(text ?? '') > value;
      return least(Data, 0.5) && least(Frames, 5) && least(Buffer, 1) && least(Late, -1);
    });
    await eventually('the frames that a busy machine was too late for are told', async () => {
      const dropped = await page.evaluate(() => (window as unknown as Inside).semblante.live.stats.dropped);
      return (await figures(page))['Dropped'] === String(dropped);
    });
    await eventually('the curve has a few samples', async () => {
      const points = await page.locator('.live-curve polyline').getAttribute('points');
      return (points ?? '').split(' ').length > 5;
    });
    await studio.keep('live-overlay-wide');
    expect(await pixels(page)).toBeLessThan(0.7); // the picture moves, and there is no graphics card
    // Another source drives the face: the figures would not be about the picture.
    await page.getByRole('button', { name: 'Pause the stream' }).click();
    await overlay.waitFor({ state: 'hidden' });
    await eventually('a still picture has all pixels', async () => (await pixels(page)) > 0.99);
    await page.getByRole('button', { name: 'Back to live' }).click();
    await overlay.waitFor();
    await page.getByText('Figures on the picture').click();
    await overlay.waitFor({ state: 'hidden' });
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Narrow_KeyboardShowsThem_AndTheyLeaveTheMiddleOfThePictureFree', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/live?stream=demo`, { width: 390, height: 844, dark: true });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.getByLabel('Figures on the picture').focus();
    await page.keyboard.press('Space');
    const overlay = page.getByRole('group', { name: 'Figures of the stream' });
    await overlay.waitFor();
    await eventually('the rate is measured', async () => parseFloat((await figures(page))['Data'] ?? '') > 0.5);
    await studio.keep('live-overlay-narrow');
    const box = (await overlay.boundingBox())!;
    expect(box.x).toBeGreaterThanOrEqual(0);
    expect(box.x + box.width).toBeLessThan(390 / 2);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});
