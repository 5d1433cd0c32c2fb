import type { Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { shownFace, untilFace, type ShownFace } from './support/face_page.ts';
import { BadNetwork } from './support/network.ts';
import { eventually, patience } from './support/patience.ts';
import { calmDown, coarse } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

let network: BadNetwork;

/** The page of the demo, by a network that can be cut. `mark` tells afterwards whether the page was loaded anew. */
async function open(): Promise<Page> {
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, deviceScaleFactor: coarse });
  await calmDown(context);
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  await page.goto(`${network.address}/view/demo`, { waitUntil: 'domcontentloaded', timeout: patience });
  await untilFace(page, 'playing');
  await page.evaluate(() => Object.assign(window, { mark: true }));
  return page;
}
const sameAsBefore = (page: Page): Promise<boolean> => page.evaluate(() => 'mark' in window);

useStudio();
beforeAll(async () => {
  network = await BadNetwork.before(server, ['delay=20']);
});
afterAll(() => network?.close());

describe('the page of a stream on a bad network', () => {
  test('NetworkGone_IsSaid_AndTheFaceComesBackByItself', async () => {
    const page = await open();
    network.tell('refuse', 'cut');
    await untilFace(page, 'stalled');
    expect((await shownFace(page)).message).toContain('Trying again');
    network.tell('accept');
    await untilFace(page, 'playing');
    expect(await sameAsBefore(page)).toBe(true);
    await page.context().close();
  });

  test('ServerKilledAndStartedAgain_TheFaceComesBackByItself', async () => {
    const page = await open();
    await server.restart();
    // The new server counts its subscribers from none.
    await eventually('the page subscribes again', async () => {
      const stream = (await (await fetch(`${server.url}/v1/streams/demo`)).json()) as { subscribers: number };
      return stream.subscribers === 1;
    });
    await untilFace(page, 'playing');
    expect(await sameAsBefore(page)).toBe(true);
    await page.context().close();
  });

  test('WithoutANetwork_ThePageOpensWithItsFace', async () => {
    const page = await open();
    // The service worker stores them some seconds after the face has begun to move.
    await eventually('the page and its face are kept', () =>
      page.evaluate(async () => {
        const names = await caches.keys();
        const kept = (await Promise.all(names.map(async (name) => (await caches.open(name)).keys()))).flat();
        const paths = kept.map(({ url }) => new URL(url).pathname);
        const needed = ['/view/', '.wasm', '.js', '/v1/streams/demo', '/rig.json', '/weights', '/mesh.drc'];
        return navigator.serviceWorker.controller !== null && needed.every((end) => paths.some((path) => path.endsWith(end)));
      }),
    );
    network.tell('refuse', 'cut');
    await page.reload({ waitUntil: 'domcontentloaded', timeout: patience });
    await page.waitForFunction(() => ((window as unknown as { semblanteFace?: ShownFace }).semblanteFace?.stats.vertices ?? 0) > 0);
    expect((await shownFace(page)).state).not.toBe('error');
    network.tell('accept');
    await untilFace(page, 'playing');
    await page.context().close();
  });
});

test('OneFinger_TurnsTheHead_InPortraitAndLandscape', async () => {
  const page = await open();
  await page.getByRole('button', { name: 'Pause' }).click();
  for (const size of [
    { width: 390, height: 844 },
    { width: 844, height: 390 },
  ]) {
    await page.setViewportSize(size);
    await page.waitForTimeout(500);
    const before = await page.screenshot();
    expect((await page.screenshot()).equals(before), 'a paused face does not move by itself').toBe(true);
    await page.mouse.move(size.width / 2, size.height / 2);
    await page.mouse.down();
    await page.mouse.move(size.width / 2 + 80, size.height / 2, { steps: 4 });
    await page.mouse.up();
    await page.waitForTimeout(500);
    expect((await page.screenshot()).equals(before), `a drag at ${size.width} x ${size.height} turns the head`).toBe(false);
  }
  await page.context().close();
});
