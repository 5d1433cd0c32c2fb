import { describe, expect, test } from 'vitest';
import { eventually } from './support/patience.ts';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

interface Point {
  distanceTo(other: Point): number;
}

/** From the camera to what it looks at. */
const distanceOf = ({ page }: StudioPage): Promise<number> =>
  page.evaluate(() => {
    const { stage } = (window as unknown as { semblante: { scene: { stage: { camera: { position: Point }; controls: { target: Point } } } } }).semblante.scene;
    return stage.camera.position.distanceTo(stage.controls.target);
  });

describe('animate', () => {
  test('FaceParameters_Search_ShowsTheMatchingOnesAndLeavesTheRestAsItWas', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 1280, height: 720 });
    const { page } = studio;
    await studio.waitForStage('ready');
    const sliders = page.locator('.fap-list .slider:visible');
    const groups = page.locator('.fap-group:visible');
    const all = await groups.count();
    await page.locator('.fap-group[data-group="7"] summary').click();
    await page.locator('.fap-list').getByText('Head pitch').waitFor();
    const search = page.getByLabel('Search face parameters');
    await search.fill('left lid');
    await page.locator('.fap-list').getByText('Close upper left eyelid').waitFor();
    expect(await sliders.count()).toBe(2);
    expect(await groups.count()).toBe(1);
    await search.fill('no such thing');
    await page.getByText('No face parameter matches.').waitFor();
    await search.fill('');
    await page.locator('.fap-list').getByText('Head pitch').waitFor();
    expect(await groups.count()).toBe(all);
    // Groups that the search opened are closed again; a group that the user opened stays open.
    expect(await page.locator('.fap-group[open]').evaluateAll((open) => open.map((one) => (one as HTMLElement).dataset['group']))).toEqual(['7']);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('RecordByHand_SlidersThatAreMoved_PlayAndLoopAsAFile', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 1280, height: 720 });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.getByRole('button', { name: 'Record by hand' }).click();
    await page.locator('[data-viseme="10"]').click();
    const stop = page.getByRole('button', { name: /^Stop, / });
    const seconds = async (): Promise<number> => Number(/[\d.]+$/.exec(await stop.innerText())![0]);
    await eventually('a second is recorded', async () => (await seconds()) >= 1);
    const before = await seconds();
    await page.locator('[data-viseme="1"]').click();
    await eventually('another half is recorded', async () => (await seconds()) >= before + 0.5);
    await stop.click();
    await page.locator('.clip').getByText('by hand.fap').waitFor();
    const visemes = await page.evaluate(() => {
      const { clip } = (window as unknown as { semblante: { driver: { clip: { clip: { frames: { time: number; state: { viseme: { select1: number } } }[] } } } } }).semblante.driver;
      return clip.clip.frames.map(({ state }) => state.viseme.select1);
    });
    expect(visemes.length).toBeGreaterThanOrEqual((before + 0.5) * 25);
    expect(visemes.filter((one) => one === 10).length).toBeGreaterThan(5);
    expect(visemes.at(-1)).toBe(1);
    await page.getByRole('button', { name: 'Pause', exact: true }).waitFor();
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('VisemePad_PointerAndKeys_BlendTheTwoNearestMouthShapes', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 1280, height: 720 });
    const { page } = studio;
    await studio.waitForStage('ready');
    const pad = page.locator('.viseme-pad');
    await pad.scrollIntoViewIfNeeded();
    const box = (await pad.boundingBox())!;
    const a = (await page.locator('.viseme-place').nth(10).boundingBox())!;
    await page.mouse.move(box.x + box.width / 2, box.y + 8);
    await page.mouse.down();
    await page.mouse.move(a.x + a.width / 2, a.y + a.height / 2, { steps: 4 });
    await page.mouse.up();
    await page.locator('[data-viseme="10"][aria-pressed=true]').waitFor();
    await page.waitForFunction(() => [...document.querySelectorAll<HTMLInputElement>('.blend .slider input')].every(({ value }) => value === '100'));
    // Towards the neighbour the shape is mixed; the other controls show it.
    await pad.focus();
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('ArrowLeft');
    await page.waitForFunction(() => document.querySelector<HTMLSelectElement>('#second-viseme')!.value === '13');
    expect(studio.errors).toEqual([]);
    await studio.keep('viseme-pad');
    await studio.close();
  });

  test('DoubleClick_OnAFaceWhoseStillModelWasNeverLoaded_GoesNearer', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 1280, height: 720 });
    const { page } = studio;
    await studio.waitForStage('ready');
    const before = await distanceOf(studio);
    const box = (await page.locator('canvas.canvas').boundingBox())!;
    await page.mouse.dblclick(box.x + box.width / 2, box.y + box.height / 2);
    expect(await distanceOf(studio)).toBeLessThan(before * 0.6);
    // Beside the head there is nothing to go to; the whole face comes back by its key.
    await page.locator('canvas.canvas').press('f');
    await page.mouse.dblclick(box.x + 4, box.y + box.height / 2);
    expect(await distanceOf(studio)).toBeCloseTo(before, 2);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Keys_QuestionMark_ShowsTheSheetButNotWhileWriting', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 390, height: 844 });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.getByLabel('Search face parameters').press('?');
    expect(await page.locator('dialog').count()).toBe(0);
    await page.locator('#tab-animate').press('?');
    await page.getByRole('dialog', { name: 'Keys' }).getByText('The whole face').waitFor();
    await studio.keep('keys-narrow');
    const box = (await page.getByRole('dialog').boundingBox())!;
    expect(box.x).toBeGreaterThanOrEqual(0);
    expect(box.x + box.width).toBeLessThanOrEqual(390);
    await page.getByRole('button', { name: 'Close' }).click();
    await page.locator('dialog').waitFor({ state: 'detached' });
    await page.getByRole('button', { name: 'Keys' }).click();
    await page.getByRole('dialog', { name: 'Keys' }).waitFor();
    await page.keyboard.press('Escape');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});
