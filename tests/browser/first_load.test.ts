import { expect, test } from 'vitest';
import { patience } from './support/patience.ts';
import type { Inside } from './support/studio_page.ts';
import { coarse } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio();

test('Studio_FirstVisit_MovesWithAtMost900kB_OfItScript300kB', async () => {
  const context = await browser.newContext({ viewport: { width: 880, height: 560 }, deviceScaleFactor: coarse, serviceWorkers: 'block' });
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  const session = await context.newCDPSession(page);
  await session.send('Network.enable');
  const loads = new Map<string, { path: string; bytes: number; at: number }>();
  let clock = 0; // of the protocol's timestamps, s
  session.on('Network.requestWillBeSent', ({ requestId, request, wallTime, timestamp }) => {
    clock = wallTime - timestamp;
    loads.set(requestId, { path: new URL(request.url).pathname, bytes: 0, at: Infinity });
  });
  session.on('Network.loadingFinished', ({ requestId, timestamp, encodedDataLength }) => {
    const load = loads.get(requestId);
    if (load) Object.assign(load, { bytes: encodedDataLength, at: (timestamp + clock) * 1000 });
  });
  await page.goto(server.url, { waitUntil: 'domcontentloaded', timeout: patience });
  // The first frame of the stream that changes the face.
  await page.waitForFunction(() => {
    const { semblante } = window as unknown as Inside;
    return semblante?.scene.state.value.kind === 'ready' && (semblante.scene.performer.value?.player?.playhead ?? NaN) > 0;
  });
  const movedAt = Date.now();
  const before = [...loads.values()].filter(({ at }) => at <= movedAt);
  const sum = (some: typeof before): number => some.reduce((bytes, load) => bytes + load.bytes, 0);
  const script = before.filter(({ path }) => /\.js$/.test(path));
  console.log(`first load ${sum(before)} bytes, of it script ${sum(script)}:\n${before.map(({ path, bytes }) => `${bytes} ${path}`).join('\n')}`);
  expect(sum(before)).toBeGreaterThan(300_000); // the head, its decoder and the page are in it
  expect(sum(before)).toBeLessThanOrEqual(900_000);
  expect(sum(script)).toBeGreaterThan(100_000);
  expect(sum(script)).toBeLessThanOrEqual(300_000);
  expect(before.map(({ path }) => path)).not.toContain('/v1/models/sample/preview.glb');
  // Without a graphics card, as here, most of the wait is for the surroundings that light the head.
  const side = await page.evaluate(
    () => (window as unknown as { semblante: { scene: { stage: { scene: { environment: { mipmaps: { width: number }[] } } } } } }).semblante.scene.stage.scene.environment.mipmaps[0]!.width,
  );
  expect(side).toBe(32);
  await context.close();
});
