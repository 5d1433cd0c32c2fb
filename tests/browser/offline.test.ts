import { expect, test } from 'vitest';
import { eventually } from './support/patience.ts';
import { startServer } from './support/server.ts';
import { coarse, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

/** What the service worker keeps of the server's answers. */
const kept = ({ page }: StudioPage): Promise<string[]> =>
  page.evaluate(async () => {
    const names = await caches.keys();
    const requests = (await Promise.all(names.map(async (name) => (await caches.open(name)).keys()))).flat();
    return requests.map(({ url }) => new URL(url).pathname);
  });

test('Studio_CanBeInstalled_ItsWorkerIsAskedForAnewEachTime', async () => {
  const page = await (await fetch(`${server.url}/`)).text();
  const manifest = /<link rel="manifest" href="\.\/([^"]+)"/.exec(page)?.[1];
  const answer = await fetch(`${server.url}/${manifest}`);
  expect(answer.headers.get('content-type')).toContain('manifest+json');
  const { icons, start_url: start, display } = (await answer.json()) as { icons: { src: string; sizes: string }[]; start_url: string; display: string };
  expect([start, display]).toEqual(['./', 'standalone']);
  expect(icons.map(({ sizes }) => sizes)).toEqual(expect.arrayContaining(['192x192', '512x512']));
  for (const { src } of icons) expect((await fetch(`${server.url}/${src}`)).status, src).toBe(200);
  const worker = await fetch(`${server.url}/worker.js`);
  expect(worker.status).toBe(200);
  expect(worker.headers.get('cache-control')).toBe('no-cache');
  expect(worker.headers.get('content-type')).toContain('javascript');
  expect(worker.headers.get('content-security-policy')).toContain("default-src 'self'");
});

test('Studio_WithoutAServer_OpensWithTheHeadsSeenAndSaysWhatDoesNotWork', async () => {
  const context = await browser.newContext({ viewport: { width: 1280, height: 720 }, deviceScaleFactor: coarse, reducedMotion: 'reduce' });
  const studio = await StudioPage.openIn(context, server.url, { allowed: /./ });
  const { page } = studio;
  await studio.waitForStage('ready');
  const needed = ['/', '.js', '.css', '/semblante_view.wasm', '/v1/models', '/models/sample/rig.json', '/models/sample/weights', '/models/sample/mesh.drc', '/feature-points'];
  await eventually('the studio and its head are kept', async () => {
    const paths = await kept(studio);
    return needed.every((end) => paths.some((path) => path.endsWith(end)));
  });
  expect(await page.locator('.offline-note').isVisible()).toBe(false);

  // No server any more; the page opens anew all the same, with the head, and says what it cannot do.
  await server.stop();
  await page.reload();
  await studio.waitForStage('ready');
  const note = page.locator('.offline-note');
  await note.getByText('No connection to the server.').waitFor();
  expect(await note.innerText()).toContain('streams need the server');
  // It can still be animated.
  const before = await studio.pictureAtRest();
  await page.locator('[data-viseme="10"]').click();
  await studio.pictureUnlike(before, [0.3, 0.3, 0.4, 0.6], 0.3);
  await studio.keep('offline');
  await studio.close();

  // Another server at another address knows nothing of it: the note goes when a server answers again.
  const other = await startServer({ demo: false });
  const again = await StudioPage.open(browser, other.url, { allowed: /./ });
  await again.waitForStage('ready');
  await again.page.route('**/*', (route) => route.abort());
  await again.page.evaluate(() => window.dispatchEvent(new Event('offline')));
  await again.page.locator('.offline-note').getByText('No connection to the server.').waitFor();
  await again.page.unroute('**/*');
  await again.page.evaluate(() => window.dispatchEvent(new Event('online')));
  await again.page.locator('.offline-note').waitFor({ state: 'hidden' });
  await again.close();
  await other.stop();
});
