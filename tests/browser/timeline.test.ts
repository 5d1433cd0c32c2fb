import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Locator, Page } from 'playwright-core';
import { afterAll, describe, expect, test } from 'vitest';
import { root } from './support/paths.ts';
import { eventually } from './support/patience.ts';
import { phone, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

const scratch = mkdtempSync(join(tmpdir(), 'semblante-timeline-'));

useStudio({ demo: false });
afterAll(() => rmSync(scratch, { recursive: true, force: true }));

interface Cue {
  time: number;
  duration: number;
  viseme?: number;
  expression?: number;
}

/** The document as it is saved. */
async function saved(page: Page): Promise<{ duration: number; cues: Cue[] }> {
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.locator('.timeline').getByRole('button', { name: 'Save' }).press('Enter'),
  ]);
  return JSON.parse(readFileSync(await download.path(), 'utf8')) as { duration: number; cues: Cue[] };
}

const timeline = (page: Page) => page.locator('.timeline');

describe('the timeline', () => {
  test('NewPerformance_ByMouse_CuesAreAddedMovedLengthenedUndoneAndPlayed', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 1440, height: 900 });
    const { page } = studio;
    await studio.waitForStage('ready');
    expect(await timeline(page).isVisible()).toBe(false);
    await page.getByRole('button', { name: 'New performance' }).click();
    await timeline(page).getByText('No cues yet').waitFor();
    await page.getByLabel('Kind of cue').selectOption('viseme-10');
    await page.getByRole('button', { name: 'Add here' }).click();
    const cue = timeline(page).locator('.cue').first();
    await cue.waitFor();
    const before = await studio.pictureAtRest();
    await page.getByLabel('From, s').fill('0.5');
    await page.getByLabel('From, s').press('Enter');
    await page.getByLabel('To, s').fill('1.5');
    await page.getByLabel('To, s').press('Enter');
    expect((await saved(page)).cues).toMatchObject([{ time: 500, duration: 1000, viseme: 10 }]);

    // A drag in the middle moves it by a second (80 pixels), one at its right edge lengthens it.
    const drag = async (part: number): Promise<void> => {
      await cue.scrollIntoViewIfNeeded();
      const box = (await cue.boundingBox())!;
      const [x, y] = [box.x + box.width * part, box.y + box.height / 2];
      await page.mouse.move(x, y);
      await page.mouse.down();
      await page.mouse.move(x + 40, y, { steps: 4 });
      await page.mouse.move(x + 80, y, { steps: 4 });
      await page.mouse.up();
    };
    await drag(0.5);
    expect((await saved(page)).cues).toMatchObject([{ time: 1500, duration: 1000 }]);
    await drag(0.98);
    expect((await saved(page)).cues).toMatchObject([{ time: 1500, duration: 2000 }]);
    await timeline(page).getByRole('button', { name: 'Undo' }).click();
    await timeline(page).getByRole('button', { name: 'Undo' }).click();
    expect((await saved(page)).cues).toMatchObject([{ time: 500, duration: 1000 }]);
    await timeline(page).getByRole('button', { name: 'Redo' }).click();
    expect((await saved(page)).cues).toMatchObject([{ time: 1500, duration: 1000 }]);

    // Scrubbed into the cue, the face shows it.
    const ruler = (await timeline(page).locator('.ruler').boundingBox())!;
    await page.mouse.click(ruler.x + 2 * 80, ruler.y + 15);
    await studio.pictureUnlike(before, [0.3, 0.4, 0.4, 0.4], 0.3);
    await studio.keep('timeline-wide');
    await timeline(page).getByRole('button', { name: 'Delete the cue' }).click();
    await timeline(page).getByText('No cues yet').waitFor();
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Example_ByKeyboard_Narrow_CuesAreChosenMovedLengthenedDeletedAndUndone', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 390, height: 844, dark: true });
    const { page } = studio;
    await studio.waitForStage('ready');
    const file = join(root, 'protocol/examples/performances/hello.json');
    const original = JSON.parse(readFileSync(file, 'utf8')) as { cues: Cue[] };
    await studio.drop(file);
    await timeline(page).locator('.cue').first().waitFor();
    expect(await timeline(page).locator('.cue').count()).toBe(original.cues.length);
    // One cue is a stop of the Tab key.
    expect(await timeline(page).locator('.cue[tabindex="0"]').count()).toBe(1);
    await timeline(page).locator('.cue[tabindex="0"]').focus();
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('ArrowUp');
    const [first] = (await saved(page)).cues;
    await timeline(page).locator('.cue[tabindex="0"]').focus();
    await page.keyboard.press('Shift+ArrowRight');
    expect((await saved(page)).cues.find(({ time }) => time === first!.time)!.duration).toBe(first!.duration + 20);
    await timeline(page).locator('.cue[tabindex="0"]').focus();
    await page.keyboard.press('Delete');
    await eventually('the cue is gone', async () => (await timeline(page).locator('.cue').count()) === original.cues.length - 1);
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+z');
    await eventually('the cue is back', async () => (await timeline(page).locator('.cue').count()) === original.cues.length);
    expect((await saved(page)).cues).toEqual(original.cues);
    await timeline(page).scrollIntoViewIfNeeded();
    await studio.keep('timeline-narrow');
    expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBeLessThanOrEqual(390);
    for (const button of await timeline(page).locator('.timeline-tools button').all())
      expect((await button.boundingBox())!.height).toBeGreaterThanOrEqual(44);
    // A loop goes over the end and on.
    await page.locator('.clip-body').getByLabel('Loop').check();
    const player = (act: 'end' | 'look'): Promise<{ position: number; playing: boolean }> =>
      page.evaluate((what) => {
        const { clip } = (window as unknown as Clips).semblante.driver;
        if (what === 'end') clip.seek(4000);
        return { position: clip.position, playing: clip.playing };
      }, act);
    expect((await player('end')).position).toBe(4000);
    if (!(await player('look')).playing) await page.locator('.clip-body').getByRole('button', { name: 'Play' }).press('Enter');
    await eventually('the loop begins again', async () => {
      const { position, playing } = await player('look');
      return playing && position > 0 && position < 3000;
    });
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Example_ByFinger_At390Pixels_CuesAreDraggedStretchedAndLongPressed', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { ...phone });
    const { page } = studio;
    await studio.waitForStage('ready');
    const file = join(scratch, 'finger.json');
    const cues = [{ time: 500, duration: 500, viseme: 10 }, { time: 2000, duration: 500, expression: 'joy' }];
    writeFileSync(file, JSON.stringify({ format: 'semblante.performance', version: 1, duration: 8000, cues }));
    await studio.drop(file);
    const [first, second] = [timeline(page).locator('.cue-viseme'), timeline(page).locator('.cue-expression')];
    await first.waitFor();
    await first.scrollIntoViewIfNeeded();
    const session = await page.context().newCDPSession(page);
    const finger = async (on: Locator, by: number, rest = 0): Promise<void> => {
      await on.scrollIntoViewIfNeeded(); // what is below the visible part of the panel gets no touch
      const box = (await on.boundingBox())!;
      const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
      const touch = (type: 'touchStart' | 'touchMove' | 'touchEnd', to: number | null): Promise<unknown> =>
        session.send('Input.dispatchTouchEvent', { type, touchPoints: to === null ? [] : [{ x: to, y }] });
      const begun = [touch('touchStart', x)];
      if (rest > 0) {
        await begun[0];
        await page.waitForTimeout(rest);
      }
      // A finger does not wait for the page: on a busy machine the first strokes would come after the time of a long press.
      for (let i = 1; i <= 8; i += 1) {
        begun.push(touch('touchMove', x + (by * i) / 8));
        if (i >= 3) await Promise.all(begun.splice(0));
      }
      await touch('touchEnd', null);
    };
    const times = async (): Promise<[number, number][]> => (await saved(page)).cues.map(({ time, duration }) => [time, duration]);

    // A finger that only passes scrolls the tracks.
    const scrolled = (): Promise<number> => timeline(page).locator('.timeline-scroll').evaluate((one) => one.scrollLeft);
    await finger(second, -60);
    await eventually('the tracks are scrolled', async () => (await scrolled()) > 20);
    expect(await times()).toEqual([[500, 500], [2000, 500]]);
    await finger(timeline(page).locator('.track').last(), 200);
    await eventually('the tracks are scrolled back', async () => (await scrolled()) === 0);

    // The chosen cue goes with the finger, 80 pixels a second, and has grips for it.
    await first.tap();
    expect(await first.getAttribute('aria-pressed')).toBe('true');
    const grips = timeline(page).locator('.cue-grip');
    await finger(first, 80);
    expect(await times()).toEqual([[1500, 500], [2000, 500]]);
    for (const grip of await grips.all()) expect((await grip.boundingBox())!.width).toBe(44);
    await studio.keep('timeline-finger');
    await finger(grips.last(), 40);
    expect(await times()).toEqual([[1500, 1000], [2000, 500]]);
    await finger(grips.first(), -40);
    expect(await times()).toEqual([[1000, 1500], [2000, 500]]);

    // A long press takes another one.
    await finger(second, -80, 600);
    expect(await times()).toEqual([[1000, 1500], [1000, 500]]);
    expect(await second.getAttribute('aria-pressed')).toBe('true');
    await timeline(page).getByRole('button', { name: 'Undo' }).tap();
    expect(await times()).toEqual([[1000, 1500], [2000, 500]]);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});

interface Clips {
  semblante: { driver: { clip: { position: number; playing: boolean; seek(position: number): void } } };
}
