import { describe, expect, test } from 'vitest';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio();

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
    expect(await page.locator('dialog').count()).toBe(0);
    await page.getByRole('button', { name: 'Keys' }).click();
    await page.getByRole('dialog', { name: 'Keys' }).waitFor();
    await page.keyboard.press('Escape');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});
