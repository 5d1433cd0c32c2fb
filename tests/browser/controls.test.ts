import { beforeAll, describe, expect, test } from 'vitest';
import { sampleHead } from './support/paths.ts';
import { phone, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });
beforeAll(async () => {
  await fetch(`${server.url}/v1/streams`, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: '{"title":"Mine"}' });
});

const tabs = ['heads', 'fit', 'points', 'animate', 'live'] as const;
const unfold = ({ page }: StudioPage): Promise<void> =>
  page.evaluate(() => document.querySelectorAll('details').forEach((one) => (one.open = true)));

describe('controls', () => {
  test('Touch_At390Pixels_EveryControlIs44PixelsWideAndTall', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#sample/animate`, { ...phone });
    const { page } = studio;
    await studio.waitForStage('ready');
    for (const box of ['influence-view', 'units-view']) await page.locator(`#${box}`).check();
    let measured = 0;
    const small = async (where: string): Promise<string[]> => {
      const [all, few] = await page.evaluate(() => {
        const names: string[] = [];
        let controls = 0;
        for (const control of document.querySelectorAll<HTMLElement>('button, input, select, summary, a[href], textarea, [role=button]')) {
          // The drawing's spots are too close together for fingers: the list below it has the same points as rows.
          if (control.closest('.guide-drawing, .visually-hidden') || control.matches('.visually-hidden, .link')) continue;
          const label = control.closest('label') ?? (control.id === '' ? null : document.querySelector(`label[for="${control.id}"]`));
          const target = label && control.matches('[type=checkbox]') ? label : control;
          const { width, height } = target.getBoundingClientRect();
          if (width === 0 || height === 0) continue;
          controls += 1;
          if (width < 43.9 || height < 43.9)
            names.push(`${control.tagName} ${control.className} ${control.textContent?.slice(0, 30)} ${Math.round(width)} x ${Math.round(height)}`);
        }
        return [controls, names] as const;
      });
      measured += all;
      return few.map((name) => `${where}: ${name}`);
    };
    const found: string[] = [];
    for (const tab of tabs) {
      await page.locator(`#tab-${tab}`).tap();
      if (tab === 'points') await page.locator('.points .section-head .segments button').last().tap();
      await unfold(studio);
      found.push(...(await small(tab)));
      const wider = await page.evaluate((name) => {
        const panel = document.querySelector(`#panel-${name}`)!;
        return panel.scrollWidth - panel.clientWidth;
      }, tab);
      expect(wider, tab).toBe(0);
    }
    await page.locator('.stream .square').first().tap();
    await page.locator('dialog[open]').waitFor();
    found.push(...(await small('a dialog')));
    expect(found).toEqual([]);
    expect(measured).toBeGreaterThan(200);
    expect(studio.errors).toEqual([]);
    await studio.close();
  });

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
});
