import { beforeAll, describe, expect, test } from 'vitest';
import { fitsThePage } from './support/checks/fits_the_page.ts';
import { sampleHead } from './support/paths.ts';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });
beforeAll(async () => {
  await fetch(`${server.url}/v1/streams`, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: '{"title":"Mine"}' });
});

describe('controls', () => {
  test('Progress_OfAnImport_IsSaidByALiveRegionUntilItIsDone', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`);
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.evaluate(() => {
      const said: string[] = [];
      const region = document.querySelector('.studio > [role=status].visually-hidden')!;
      new MutationObserver(() => said.push(region.textContent!)).observe(region, { childList: true, characterData: true, subtree: true });
      Object.assign(window, { said });
    });
    await studio.drop(sampleHead, 'another.glb');
    await page.waitForFunction(() => (window as unknown as { said: string[] }).said.at(-1) === 'Done.');
    const said = await page.evaluate(() => (window as unknown as { said: string[] }).said);
    expect(said.some((text) => /another/.test(text)), said.join(' | ')).toBe(true);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('ForcedColors_ABar_ShowsHowFullItIs', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/points`, { width: 1280, height: 800 });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.emulateMedia({ forcedColors: 'active' });
    const [fill, ground] = await page.locator('.meter .bar > span').evaluate((one) => [one, document.body].map((part) => getComputedStyle(part).backgroundColor));
    expect(fill).not.toBe(ground);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Keyboard_EachTab_HasFewStopsAndEachOfThemIsSeen', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 1280, height: 800 });
    const { page } = studio;
    await studio.waitForStage('ready');
    // Of the whole page: head and shelf are 8 of them.
    const most = { fit: 40, points: 32, animate: 65, live: 42 };
    for (const tab of ['fit', 'points', 'animate', 'live'] as const) {
      await page.locator(`#tab-${tab}`).click();
      if (tab === 'points') await page.locator('.points .section-head .segments button').last().click();
      await page.locator(`#tab-${tab}`).focus();
      let stops = 0;
      const unseen: string[] = [];
      for (;;) {
        await page.keyboard.press('Tab');
        stops += 1;
        const [name, outlined, back] = await page.evaluate((start) => {
          const one = document.activeElement!;
          const { outlineStyle, outlineWidth } = getComputedStyle(one);
          return [one.outerHTML.slice(0, 80), outlineStyle !== 'none' && parseFloat(outlineWidth) >= 2, one.id === start] as const;
        }, `tab-${tab}`);
        if (back || stops > 120) break;
        if (!outlined && !name.startsWith('<body')) unseen.push(name);
      }
      expect(unseen, tab).toEqual([]);
      expect(stops, tab).toBeLessThanOrEqual(most[tab]);
    }
    // A control that removes itself leaves the focus in its place, not at the beginning of the page.
    await page.locator('[aria-label="Delete stream Mine"]').focus();
    for (const key of ['Enter', 'Tab', 'Enter']) await page.keyboard.press(key);
    await page.locator('[data-stream]').waitFor({ state: 'detached' });
    expect(await page.evaluate(() => document.activeElement!.getAttribute('aria-label'))).toBe('New stream');
    // The arrow keys lead through a list that is one stop.
    await page.locator('#tab-points').click();
    await page.locator('[data-point="2.1"]').focus();
    await page.keyboard.press('ArrowDown');
    expect(await page.evaluate(() => (document.activeElement as HTMLElement).dataset['point'])).toBe('2.2');
    await page.keyboard.press('End');
    expect(await page.evaluate(() => (document.activeElement as HTMLElement).dataset['point'])).toBe('11.6');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Page_AtFourTimesTheSize_CutsNoControlOff', async () => {
    for (const [width, height] of [[320, 256], [561, 320]] as const) {
      const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width, height });
      const { page } = studio;
      await studio.waitForStage('ready');
      for (const tab of ['heads', 'fit', 'points', 'animate', 'live']) {
        await page.locator(`#tab-${tab}`).click();
        const cut = await page.locator(`:is(.tabs, #panel-${tab}) :is(button, input, select):visible`).evaluateAll((controls) =>
          controls.filter((one) => {
            one.scrollIntoView({ block: 'center' });
            const { left, right, top, bottom } = one.getBoundingClientRect();
            const box = document.querySelector('.inspector')!.getBoundingClientRect();
            return left < box.left - 1 || right > box.right + 1 || top < 0 || bottom > innerHeight;
          }).map((one) => one.outerHTML.slice(0, 90)),
        );
        expect(cut, `${tab}, ${width} by ${height}`).toEqual([]);
      }
      const words = await page.locator('.tab > .icon + span').evaluateAll((spans) => spans.map((span) => span.getBoundingClientRect()).map(({ left, right }) => ({ left, right })));
      for (const [i, { left }] of words.entries()) if (i > 0) expect(left, `tabs, ${width} by ${height}`).toBeGreaterThanOrEqual(words[i - 1]!.right);
      await studio.keep(`four-times-${width}-${height}`);
      expect(studio.errors).toEqual([]);
      await studio.close();
    }
  });

  test('Facts_OfAStream_OnTheNarrowestPhoneWithLettersOf24Pixels_AreNotCutOff', async () => {
    await fetch(`${server.url}/v1/streams`, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: '{"name":"facts"}' });
    // 320 pixels at such letters are as wide as 213 at the usual size.
    const studio = await StudioPage.open(browser, `${server.url}/#sample/live?stream=facts`, { width: 213, height: 467 });
    const { page } = studio;
    const facts = page.locator('.facts dd');
    await facts.last().filter({ hasText: 'Default of the head' }).waitFor();
    expect(await facts.evaluateAll((all) => all.filter((one) => one.scrollWidth > one.clientWidth).map((one) => one.textContent))).toEqual([]);
    expect(await fitsThePage.faults(studio)).toEqual([]);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

  test('Page_OfAPhoneWithLettersOf24Pixels_CutsNoWordsOff', async () => {
    // Larger letters do what a zoom does: 390 pixels are as wide as 260 are at the usual size.
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { width: 260, height: 563 });
    const { page } = studio;
    await studio.waitForStage('ready');
    for (const tab of ['heads', 'fit', 'points', 'live', 'animate']) {
      await page.locator(`#tab-${tab}`).click();
      expect(await fitsThePage.faults(studio), tab).toEqual([]);
    }
    const wide = (words: string): Promise<string[]> =>
      page.locator(words).evaluateAll((all) => all.filter((one) => one.scrollWidth > one.clientWidth).map((one) => one.textContent!));
    expect(await wide('.tab')).toEqual([]);
    await page.getByRole('button', { name: 'Code', exact: true }).click();
    await page.locator('dialog[open]').waitFor();
    expect(await wide('dialog .segments button')).toEqual([]);
    expect(await fitsThePage.faults(studio), 'programs').toEqual([]);
    await page.keyboard.press('Escape');
    await page.locator('#tab-heads').click();
    await page.locator('.head-actions button').last().click();
    const [cancel] = await page.locator('dialog .row.end button').evaluateAll((all) => all.map((one) => one.clientHeight));
    expect(cancel, 'its word is in one line').toBeLessThan(40);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});
