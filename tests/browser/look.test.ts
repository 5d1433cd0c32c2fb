import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import type { BrowserContextOptions } from 'playwright-core';
import { untilFace } from './support/face_page.ts';
import { buildDir, root } from './support/paths.ts';
import { startServer, type RunningServer } from './support/server.ts';
import { coarse, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

/** Every screen in every look, to be looked at by people; without it two looks, whose layout alone is checked. */
const all = process.env['SEMBLANTE_SCREENS'] === 'all';

const sizes = {
  wide: { viewport: { width: 1440, height: 900 } },
  laptop: { viewport: { width: 1024, height: 700 } },
  phone: { viewport: { width: 390, height: 844 }, isMobile: true, hasTouch: true },
} satisfies Record<string, BrowserContextOptions>;

interface Look {
  name: string;
  options: BrowserContextOptions;
}
const looks: Look[] = Object.entries(sizes).flatMap(([size, options]) =>
  (['light', 'dark'] as const).flatMap((colorScheme) =>
    ['en-US', 'pt-BR'].map((locale) => ({
      name: `${size}-${colorScheme}-${locale.slice(0, 2)}`,
      options: { ...options, colorScheme, locale, reducedMotion: 'reduce' as const },
    })),
  ),
);
const chosen = all ? looks : looks.filter(({ name }) => name === 'wide-light-en' || name === 'phone-dark-pt');

useStudio({ allowOrigin: '*' }); // the element's page is of another port
let empty: RunningServer;
let closed: RunningServer;
const folder = mkdtempSync(join(tmpdir(), 'semblante-look-'));
beforeAll(async () => {
  [empty, closed] = await Promise.all([startServer({ demo: false }), startServer({ demo: false, tokenScope: 'edit' })]);
  await fetch(`${empty.url}/v1/models/sample`, { method: 'DELETE' });
  const odd = ['v 0 0 0', 'v 1 0 0', 'v 0 1 0', 'v 0 0 1', 'v 0 0 -1', 'f 1 2 3', 'f 1 2 4', 'f 1 2 5', 'f 1 3 4'].join('\n');
  await fetch(`${server.url}/v1/models?name=Odd`, { method: 'POST', headers: { 'Content-Type': 'model/obj' }, body: odd });
  writeFileSync(join(folder, 'letter.glb'), 'Dear Ana, here is the head that you asked for.');
});
afterAll(async () => {
  await Promise.all([empty?.stop(), closed?.stop()]);
  rmSync(folder, { recursive: true, force: true });
});

const tabs = ['animate', 'fit', 'points', 'live'] as const;

/** A page in one look, whose screens are checked and, if all are wanted, kept. */
class Screens {
  private constructor(
    readonly studio: StudioPage,
    private readonly look: Look,
  ) {}

  static async open(look: Look, url: string, allowed?: RegExp): Promise<Screens> {
    const context = await browser.newContext({ deviceScaleFactor: all ? 1 : coarse, ...look.options });
    return new Screens(await StudioPage.openIn(context, url, allowed ? { allowed } : {}), look);
  }

  /** No element overflows horizontally, and the page itself does not scroll. */
  async shot(name: string): Promise<void> {
    const { page } = this.studio;
    await this.studio.drawn(3);
    const overflow = await page.evaluate(() => [
      document.documentElement.scrollWidth - innerWidth,
      document.documentElement.scrollHeight - innerHeight,
      ...[...document.querySelectorAll('.panel, .panel-foot, dialog')].map((one) => one.scrollWidth - one.clientWidth).filter((wide) => wide > 0),
    ]);
    expect(overflow, name).toEqual([0, 0]);
    if (all) await this.studio.keep(`screens/${this.look.name}-${name}`);
  }

  /** A panel from its top to its end, a screen at a time. */
  async scroll(name: string, panel: string): Promise<void> {
    for (let part = 1; part < 8; part += 1) {
      await this.shot(`${name}-${part}`);
      if (!all) return;
      const moved = await this.studio.page.locator(panel).evaluate((element) => {
        const scroller = [element, ...element.querySelectorAll('*')].find((one) => one.scrollHeight > one.clientHeight + 4 && /auto|scroll/.test(getComputedStyle(one).overflowY));
        const before = scroller?.scrollTop ?? 0;
        scroller?.scrollBy({ top: scroller.clientHeight * 0.9, behavior: 'instant' });
        return (scroller?.scrollTop ?? 0) > before + 4;
      });
      if (!moved) return;
    }
  }

  async dialog(name: string): Promise<void> {
    await this.studio.page.locator('dialog[open]').waitFor();
    await this.shot(name);
    await this.studio.page.keyboard.press('Escape');
  }

  close(): Promise<void> {
    return this.studio.close();
  }
}

/** The example page of the element, beside its package, as somebody's server has it. */
async function serveExample(): Promise<{ url: string; stop(): void }> {
  const types: Record<string, string> = { '.js': 'text/javascript', '.wasm': 'application/wasm', '.html': 'text/html' };
  const files = createServer((request, answer) => {
    const path = request.url === '/' ? join(root, 'clients/js/example.html') : join(buildDir, 'npm/semblante', request.url ?? '');
    try {
      const content = request.url === '/' ? readFileSync(path, 'utf8').replace('http://127.0.0.1:8080', server.url) : readFileSync(path);
      answer.writeHead(200, { 'Content-Type': types[extname(path)] ?? 'application/octet-stream' }).end(content);
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise<void>((ready) => files.listen(0, '127.0.0.1', ready));
  return { url: `http://127.0.0.1:${(files.address() as { port: number }).port}/`, stop: () => files.close() };
}

describe('look', () => {
  for (const look of chosen) {
    test(`Screens_${look.name}_FitThePage`, async () => {
      const screens = await Screens.open(look, `${server.url}/#sample/animate`, /status of 4\d\d|ERR_FAILED/);
      const { studio } = screens;
      const { page } = studio;
      await studio.waitForStage('ready');
      if (all) await page.locator('.driver button').first().click(); // the face rests: less to draw, and pictures that can be compared

      for (const tab of tabs) {
        await page.locator(`#tab-${tab}`).click();
        await screens.scroll(tab, `#panel-${tab}`);
      }
      await page.locator('#tab-points').click();
      await page.locator('.points .section-head .segments button').last().click();
      await screens.shot('points-list');
      await page.locator('[data-point="8.1"]').click();
      await screens.shot('point-chosen');

      await page.locator('#tab-live').click();
      await page.locator('.stream .square').first().click();
      await screens.dialog('dialog-phone');
      await page.locator('.live .section-head .square').first().click();
      await screens.dialog('dialog-stream');
      await page.locator('#tab-live').press('?');
      await screens.dialog('dialog-keys');

      await page.locator('#tab-animate').click();
      await page.getByRole('button', { name: /^(Code|Código)$/ }).click();
      await screens.dialog('dialog-code');
      for (const box of ['influence-view', 'units-view']) await page.locator(`#${box}`).check();
      await page.locator('[data-expression="1"]').click();
      await page.locator('[data-viseme="2"]').click();
      await screens.shot('influence');
      for (const box of ['influence-view', 'units-view']) await page.locator(`#${box}`).uncheck();
      await page.evaluate(() => document.querySelectorAll('details').forEach((one) => (one.open = true)));
      await screens.scroll('animate-unfolded', '#panel-animate');

      const shelfTab = page.locator('#tab-heads'); // on a narrow page, as phones and small laptops have
      if (await shelfTab.isVisible()) await shelfTab.click();
      await page.locator('.head').first().hover();
      await screens.shot('heads');
      await page.locator('.head-actions button').last().click();
      await screens.dialog('dialog-deletion');
      await page.locator('.head-actions button').first().click();
      await screens.dialog('dialog-name');

      // A head with findings and without points, and a file that is no head.
      await page.locator('.head', { hasText: 'Odd' }).locator('.open').click();
      await page.locator('#tab-fit').click();
      await page.locator('.finding-show').first().click();
      await screens.scroll('findings', '#panel-fit');
      await page.locator('#tab-points').click();
      expect(await page.locator('#panel-points').evaluate((panel) => panel.scrollTop), 'another head is read from the top').toBe(0);
      await screens.shot('points-none');
      await page.locator('#tab-animate').click();
      await screens.shot('animate-none');
      await studio.drop(join(folder, 'letter.glb'));
      await page.locator('.toast-error, .stage-card.error').first().waitFor();
      await screens.shot('refused');
      await page.route('**/v1/**', (route) => route.abort());
      await page.reload();
      await page.locator('.stage-card.error').waitFor();
      await screens.shot('no-server');
      await screens.close();

      const none = await Screens.open(look, empty.url);
      await none.studio.page.locator('.stage-card, .stage-empty, .drop').first().waitFor();
      for (const tab of all ? tabs : (['animate'] as const)) {
        await none.studio.page.locator(`#tab-${tab}`).click();
        await none.shot(`empty-${tab}`);
      }
      expect(none.studio.errors).toEqual([]);
      await none.close();

      const outside = await Screens.open(look, closed.url, /status of 401/);
      await outside.studio.page.getByLabel('Token').fill('smb_wrong_token');
      await outside.studio.page.getByLabel('Token').press('Enter');
      await outside.studio.page.getByRole('alert').getByText(look.name.endsWith('pt') ? 'nunca foi criado, ou foi revogado.' : 'not accepted').waitFor();
      await outside.shot('sign-in');
      await outside.close();

      // The page of a phone, and the element in somebody's page.
      if (!all) return;
      const example = await serveExample();
      try {
        for (const [name, url, state] of [
          ['view', `${server.url}/view/demo`, 'playing'],
          ['view-unknown', `${server.url}/view/nobody`, 'error'],
          ['example', example.url, ''],
        ] as const) {
          const one = await Screens.open(look, url, /./);
          if (state === 'playing') await untilFace(one.studio.page, 'playing', 'resting'); // less motion is asked for: it waits for Play
          await one.studio.page.waitForTimeout(state === 'playing' ? 500 : 4000); // the rest has no event to wait for
          await one.studio.keep(`screens/${look.name}-${name}`);
          await one.close();
        }
      } finally {
        example.stop();
      }
    });
  }

  test('Studio_EveryControl_HasAName', async () => {
    const studio = await StudioPage.open(browser, server.url);
    await studio.waitForStage('ready');
    const nameless = await studio.page.evaluate(() =>
      [...document.querySelectorAll<HTMLElement>('button, input, select')]
        .filter((element) => {
          const label = element.getAttribute('aria-label') ?? element.textContent?.trim() ?? '';
          const labelled = element.id !== '' && document.querySelector(`label[for="${element.id}"]`) !== null;
          return label === '' && !labelled && element.closest('label') === null;
        })
        .map((element) => element.outerHTML.slice(0, 120)),
    );
    expect(nameless).toEqual([]);
    await studio.close();
  });
});
