import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { extname, join } from 'node:path';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import type { Check } from './support/checks/check.ts';
import { controlsHaveNames } from './support/checks/controls_have_names.ts';
import { fitsThePage } from './support/checks/fits_the_page.ts';
import { largeTargets } from './support/checks/large_targets.ts';
import { noEnglish } from './support/checks/no_english.ts';
import { nothingSerious } from './support/checks/nothing_serious.ts';
import { untilFace } from './support/face_page.ts';
import { keepsPictures, looks, type Look } from './support/looks.ts';
import { buildDir, root } from './support/paths.ts';
import { goToEachScreen, goToEmptyScreens, goToSignIn } from './support/screens.ts';
import { startServer, type RunningServer } from './support/server.ts';
import { coarse, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

const checks: Check[] = [fitsThePage, nothingSerious, noEnglish, largeTargets, controlsHaveNames];
/** Fewer controls than the screens of a look have together: a walk over empty pages would check nothing. */
const fewestControls = 500;

// Nothing moves: axe needs the machine for itself. The element's page is of another port.
useStudio({ demo: keepsPictures, allowOrigin: '*' });
let empty: RunningServer;
let closed: RunningServer;
const folder = mkdtempSync(join(tmpdir(), 'semblante-screens-'));
const letter = join(folder, 'letter.glb');
beforeAll(async () => {
  [empty, closed] = await Promise.all([startServer({ demo: false }), startServer({ demo: false, tokenScope: 'edit' })]);
  await fetch(`${empty.url}/v1/models/sample`, { method: 'DELETE' });
  const post = (path: string, type: string, body: string): Promise<Response> =>
    fetch(`${server.url}/v1/${path}`, { method: 'POST', headers: { 'Content-Type': type }, body });
  await post('streams', 'application/json', '{"title":"Demo"}');
  const odd = ['v 0 0 0', 'v 1 0 0', 'v 0 1 0', 'v 0 0 1', 'v 0 0 -1', 'f 1 2 3', 'f 1 2 4', 'f 1 2 5', 'f 1 3 4'].join('\n');
  await post('models?name=Odd', 'model/obj', odd);
  writeFileSync(letter, 'Dear Ana, here is the head that you asked for.');
});
afterAll(async () => {
  await Promise.all([empty?.stop(), closed?.stop()]);
  rmSync(folder, { recursive: true, force: true });
});

async function open({ options }: Look, url: string, allowed?: RegExp): Promise<StudioPage> {
  const context = await browser.newContext({ deviceScaleFactor: keepsPictures ? 1 : coarse, serviceWorkers: 'block', ...options });
  return StudioPage.openIn(context, url, { sharp: keepsPictures, ...(allowed ? { allowed } : {}) });
}

/** Keeps pictures of a panel from its top to its end, a screen at a time. */
async function keepPictures(studio: StudioPage, name: string, panel?: string): Promise<void> {
  await studio.keep(panel ? `${name}-1` : name);
  for (let part = 2; panel && part < 8; part += 1) {
    const moved = await studio.page.locator(panel).evaluate((element) => {
      const scroller = [element, ...element.querySelectorAll('*')].find((one) => one.scrollHeight > one.clientHeight + 4 && /auto|scroll/.test(getComputedStyle(one).overflowY));
      const before = scroller?.scrollTop ?? 0;
      scroller?.scrollBy({ top: scroller.clientHeight * 0.9, behavior: 'instant' });
      return (scroller?.scrollTop ?? 0) > before + 4;
    });
    if (!moved) return;
    await studio.drawn(3);
    await studio.keep(`${name}-${part}`);
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

describe.each(looks)('screens, $name', (look) => {
  /** By check: what is wrong, and on which screen. */
  const faults = new Map<Check, string[]>(checks.filter(({ isFor }) => isFor?.(look) ?? true).map((check) => [check, []]));
  let controls = 0;
  const visit = async (studio: StudioPage, screen: string, panel?: string): Promise<void> => {
    await studio.drawn(2);
    controls += await studio.page.locator('button:visible, input:visible, select:visible').count();
    for (const [check, found] of faults) found.push(...(await check.faults(studio)).map((fault) => `${screen}: ${fault}`));
    if (keepsPictures) await keepPictures(studio, `screens/${look.name}-${screen}`, panel);
  };

  beforeAll(async () => {
    const studio = await open(look, `${server.url}/#sample/animate`, /status of 4\d\d|ERR_FAILED/);
    await studio.waitForStage('ready');
    if (keepsPictures) await studio.page.locator('.driver button').first().click(); // the face rests: less to draw, and pictures that can be compared
    await goToEachScreen(studio, letter, visit);
    await studio.close();

    const none = await open(look, empty.url);
    await goToEmptyScreens(none, visit);
    expect(none.errors).toEqual([]);
    await none.close();

    const outside = await open(look, closed.url, /status of 401/);
    await goToSignIn(outside, look.options.locale === 'pt-BR' ? 'nunca foi criado, ou foi revogado.' : 'not accepted', visit);
    await outside.close();
  });

  for (const [check, found] of faults) {
    test(`EachScreen_${check.name}`, () => {
      expect(found).toEqual([]);
      expect(controls).toBeGreaterThan(fewestControls);
    });
  }

  test.runIf(keepsPictures)('PageOfAPhone_AndTheElementInSomebodysPage_AreKept', async () => {
    const example = await serveExample();
    try {
      for (const [name, url, state] of [
        ['view', `${server.url}/view/demo`, 'playing'],
        ['view-unknown', `${server.url}/view/nobody`, 'error'],
        ['example', example.url, ''],
      ] as const) {
        const one = await open(look, url, /./);
        if (state === 'playing') await untilFace(one.page, 'playing', 'resting'); // less motion is asked for: it waits for Play
        await one.page.waitForTimeout(state === 'playing' ? 500 : 4000); // the rest has no event to wait for
        await one.keep(`screens/${look.name}-${name}`);
        await one.close();
      }
    } finally {
      example.stop();
    }
  });
});
