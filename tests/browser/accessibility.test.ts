import { join } from 'node:path';
import axe, { type AxeResults } from 'axe-core';
import type { BrowserContextOptions } from 'playwright-core';
import { beforeAll, describe, expect, test } from 'vitest';
import { root } from './support/paths.ts';
import { startServer } from './support/server.ts';
import { coarse, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';
import { everyVariant } from './support/variants.ts';

useStudio({ demo: false });
beforeAll(async () => {
  // A stream, and a head with findings, so that lists have what their items have. Nothing moves: axe needs the machine for itself.
  await fetch(`${server.url}/v1/streams`, { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: '{"title":"Mine"}' });
  const odd = ['v 0 0 0', 'v 1 0 0', 'v 0 1 0', 'v 0 0 1', 'v 0 0 -1', 'f 1 2 3', 'f 1 2 4', 'f 1 2 5', 'f 1 3 4'].join('\n');
  await fetch(`${server.url}/v1/models?name=Odd`, { method: 'POST', headers: { 'Content-Type': 'model/obj' }, body: odd });
});

/** Serious and critical findings of axe on the page as it is. */
async function findings({ page }: StudioPage, where: string): Promise<string[]> {
  await page.evaluate(axe.source);
  const { violations } = await page.evaluate(
    () =>
      (window as unknown as { axe: typeof axe }).axe.run(document, {
        resultTypes: ['violations'],
        runOnly: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'],
      }) as Promise<AxeResults>,
  );
  return violations
    .filter(({ impact }) => impact === 'serious' || impact === 'critical')
    .flatMap(({ id, nodes }) => nodes.map(({ target, failureSummary }) => `${where}: ${id} ${target.join(' ')}: ${failureSummary}`));
}

/** Opens everything that is folded. */
const unfold = ({ page }: StudioPage): Promise<void> =>
  page.evaluate(() => document.querySelectorAll('details').forEach((one) => (one.open = true)));

interface Look {
  name: string;
  /** Looked at only with `everyVariant`. */
  extra?: true;
  options: BrowserContextOptions;
}

const wide = { viewport: { width: 1440, height: 900 } };
const narrow = { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true };
const everyLook: Look[] = [
  { name: 'wide light', options: { ...wide, colorScheme: 'light' } },
  { name: 'wide dark', extra: true, options: { ...wide, colorScheme: 'dark', locale: 'pt-BR' } },
  { name: 'narrow light', extra: true, options: { ...narrow, colorScheme: 'light' } },
  { name: 'narrow dark', options: { ...narrow, colorScheme: 'dark', locale: 'pt-BR' } },
];
const looks = everyLook.filter(({ extra }) => everyVariant || !extra);

async function open({ options }: Look, at: string, allowed?: RegExp): Promise<StudioPage> {
  const context = await browser.newContext({ reducedMotion: 'reduce', deviceScaleFactor: coarse, ...options });
  return StudioPage.openIn(context, server.url + at, allowed ? { allowed } : {});
}

describe('accessibility', () => {
  for (const look of looks) {
    test(`Axe_${look.name.replace(' ', '')}_NothingSeriousOnAnyTabOrDialog`, async () => {
      const studio = await open(look, '/#sample/animate');
      const { page } = studio;
      const found: string[] = [];
      const check = async (where: string): Promise<void> => {
        found.push(...(await findings(studio, where)));
      };
      await studio.waitForStage('ready');
      // Everything of the tab that is folded or switched on by hand.
      for (const box of ['influence-view', 'units-view']) await page.locator(`#${box}`).check();
      await unfold(studio);
      await page.locator('[data-expression="1"]').click();
      await page.locator('[data-viseme="2"]').click();
      await check('animate');

      await page.locator('#tab-fit').click();
      await unfold(studio);
      await check('fit');

      await page.locator('#tab-points').click();
      for (const mode of await page.locator('.points .section-head .segments button').all()) {
        await mode.click();
        await check('points');
      }
      await page.locator('[data-point="8.1"]').click();
      await check('a chosen point');

      await page.locator('#tab-live').click();
      await page.locator('.stream').first().waitFor();
      await check('live');
      await page.locator('.stream .square').first().click();
      await page.locator('dialog[open]').waitFor();
      await check('the dialog of a phone');
      await page.keyboard.press('Escape');
      await page.locator('.live .section-head .square').first().click();
      await page.locator('dialog[open]').waitFor();
      await check('the dialog of a stream');
      await page.keyboard.press('Escape');
      await page.locator('#tab-live').press('?');
      await page.locator('dialog[open] dl.keys').first().waitFor();
      await check('the sheet of keys');
      await page.keyboard.press('Escape');

      if (look.options.viewport!.width < 1080) await page.locator('#tab-heads').click();
      await page.locator('.head').first().hover();
      await check('heads');
      await page.locator('.head-actions button').last().click();
      await page.locator('dialog[open]').waitFor();
      await check('the dialog of a deletion');
      await page.keyboard.press('Escape');
      await page.locator('.head-actions button').first().click();
      await page.locator('dialog[open] input').waitFor();
      await check('the dialog of a name');
      await page.keyboard.press('Escape');
      expect(found).toEqual([]);
      expect(studio.errors).toEqual([]);
      await studio.close();
    });
  }

  for (const look of looks) {
    test(`Axe_${look.name.replace(' ', '')}_NothingSeriousWhereSomethingIsWrong`, async () => {
      const studio = await open(look, '/#sample/fit', /status of 4\d\d|ERR_FAILED/);
      const { page } = studio;
      const found: string[] = [];
      await studio.waitForStage('ready');
      // A head with findings, and a file that is no head.
      if (look.options.viewport!.width < 1080) await page.locator('#tab-heads').click();
      await page.locator('.head', { hasText: 'Odd' }).locator('.open').click();
      await page.locator('#tab-fit').click();
      await page.locator('.finding-show').first().click();
      await unfold(studio);
      found.push(...(await findings(studio, 'findings')));
      await studio.drop(join(root, 'LICENSE'), 'letter.glb');
      await page.locator('.toast-error, .stage-card.error').first().waitFor();
      found.push(...(await findings(studio, 'a refused head')));
      // A server that does not answer.
      await page.route('**/v1/**', (route) => route.abort());
      await page.reload();
      await page.locator('.stage-card.error').waitFor();
      found.push(...(await findings(studio, 'no server')));
      expect(found).toEqual([]);
      await studio.close();
    });
  }
});

test('Axe_SignIn_NothingSerious', async () => {
  const closed = await startServer({ tokenScope: 'edit' });
  try {
    for (const colorScheme of ['light', 'dark'] as const) {
      const context = await browser.newContext({ colorScheme });
      const studio = await StudioPage.openIn(context, closed.url, { allowed: /status of 401/ });
      await studio.page.getByLabel('Token').fill('smb_wrong_token');
      await studio.page.getByRole('button', { name: 'Sign in' }).click();
      await studio.page.getByRole('alert').getByText('not accepted').waitFor();
      expect(await findings(studio, `sign-in, ${colorScheme}`)).toEqual([]);
      await studio.close();
    }
  } finally {
    await closed.stop();
  }
});
