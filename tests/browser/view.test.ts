import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { shownFace, untilFace, type ShownFace } from './support/face_page.ts';
import { patience } from './support/patience.ts';
import { calmDown, coarse } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio();
async function open(path: string, options: { reducedMotion?: 'reduce'; noWebGl?: boolean; locale?: string; sharp?: boolean } = {}): Promise<{ page: Page; errors: string[] }> {
  const context = await browser.newContext({
    viewport: { width: 390, height: 844 },
    deviceScaleFactor: options.sharp ? 1 : coarse,
    reducedMotion: options.reducedMotion ?? 'no-preference',
    locale: options.locale ?? 'en-US',
  });
  await calmDown(context);
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  const errors: string[] = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => {
    if (message.type() === 'error' && !/Failed to load resource|WebSocket/.test(message.text())) errors.push(message.text());
  });
  if (options.noWebGl) {
    await page.addInitScript(() => {
      HTMLCanvasElement.prototype.getContext = () => null;
    });
  }
  await page.goto(server.url + path, { waitUntil: 'domcontentloaded', timeout: patience });
  return { page, errors };
}

test('View_Demo_MovesWithLessThan250kB', async () => {
  const { page, errors } = await open('/view/demo');
  await untilFace(page, 'playing'); // nothing of this first visit may still be loading when the next one is counted
  const session = await page.context().newCDPSession(page);
  await session.send('Network.enable');
  await session.send('Network.setCacheDisabled', { cacheDisabled: true });
  // When the face began to move, and when each response was complete: on a busy machine the page is asked later.
  await page.addInitScript(() => {
    document.addEventListener('playing', () => Object.assign(window, { movedAt: performance.timeOrigin + performance.now() }), {
      capture: true,
      once: true,
    });
  });
  let clock = 0; // of the protocol's timestamps, s
  const paths = new Map<string, string>(); // of each request
  const responses: { at: number; bytes: number; path: string }[] = [];
  session.on('Network.requestWillBeSent', ({ requestId, request, wallTime, timestamp }) => {
    clock = wallTime - timestamp;
    paths.set(requestId, new URL(request.url).pathname);
  });
  session.on('Network.loadingFinished', ({ requestId, timestamp, encodedDataLength }) =>
    responses.push({ at: (timestamp + clock) * 1000, bytes: encodedDataLength, path: paths.get(requestId) ?? requestId }),
  );
  await page.reload({ waitUntil: 'domcontentloaded' });
  await untilFace(page, 'playing');
  const movedAt = await page.evaluate(() => (window as unknown as { movedAt: number }).movedAt);
  const before = responses.filter(({ at }) => at <= movedAt);
  const moved = before.reduce((sum, { bytes }) => sum + bytes, 0);
  const list = before.map(({ bytes, path }) => `${bytes} ${path}`).join('\n');
  expect(moved, list).toBeGreaterThan(100_000); // the head and its decoder are in it
  expect(moved, list).toBeLessThanOrEqual(250_000);
  expect(await page.getByRole('img', { name: 'Animated face, stream demo' }).count()).toBe(1);
  expect(errors).toEqual([]);
  await page.context().close();
});

test('View_UnknownStream_SaysSo_AndShowsItOnceItIsThere', async () => {
  const { page, errors } = await open('/view/later');
  await untilFace(page, 'error');
  expect((await shownFace(page)).message).toContain('There is no stream “later”');
  await page.locator('.corner').waitFor({ state: 'hidden' }); // there is no connection to tell of
  const create = await fetch(`${server.url}/v1/streams`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: '{"name":"later"}',
  });
  expect(create.status).toBe(201);
  await page.waitForFunction(() => (window as unknown as { semblanteFace: ShownFace }).semblanteFace.message.includes('has no face yet'));
  await fetch(`${server.url}/v1/streams/later`, { method: 'DELETE' });
  await fetch(`${server.url}/v1/streams`, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: '{"name":"later","model":"sample"}',
  });
  await untilFace(page, 'resting', 'playing');
  await fetch(`${server.url}/v1/streams/later`, { method: 'DELETE' });
  await untilFace(page, 'ended');
  expect(errors).toEqual([]);
  await page.context().close();
});

test('View_NoStreamNamed_SaysSoInTheMiddle', async () => {
  const { page, errors } = await open('/view/');
  await page.getByText('No stream is named').waitFor();
  const middle = await page.locator('main').evaluate((main) => {
    const words = document.createRange();
    words.selectNodeContents(main);
    const { left, right, top, bottom } = words.getBoundingClientRect();
    return [(left + right) / 2 / innerWidth, (top + bottom) / 2 / innerHeight];
  });
  for (const part of middle) expect(part).toBeCloseTo(0.5, 1);
  expect(errors).toEqual([]);
  await page.context().close();
});

test('View_LessMotionWished_WaitsForPlay_InPortugueseToo', async () => {
  const { page, errors } = await open('/view/demo', { reducedMotion: 'reduce', locale: 'pt-BR' });
  await untilFace(page, 'resting');
  expect(await page.locator('html').getAttribute('lang')).toBe('pt-BR');
  await page.getByRole('img', { name: 'Rosto animado, fluxo demo' }).waitFor();
  await page.getByRole('button', { name: 'Legendas' }).waitFor();
  // On a busy machine the connection is not always good; the test is of the language.
  expect((await page.getByRole('status').allInnerTexts()).join()).toMatch(/Conexão (boa|lenta|ruim)/);
  await page.getByRole('button', { name: 'Reproduzir' }).first().click();
  await untilFace(page, 'playing');
  expect(errors).toEqual([]);
  await page.context().close();
});

/** The contrast between what is drawn brightest and darkest in a picture: 1 to 21. */
const contrastIn = (page: Page, png: Buffer): Promise<number> =>
  page.evaluate(async (base64) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${base64}`)).blob());
    const context = new OffscreenCanvas(image.width, image.height).getContext('2d')!;
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(0, 0, image.width, image.height);
    const linear = (value: number): number => (value <= 10 ? value / 3294 : ((value / 255 + 0.055) / 1.055) ** 2.4);
    let [low, high] = [1, 0];
    for (let i = 0; i < data.length; i += 4) {
      const luminance = 0.2126 * linear(data[i]!) + 0.7152 * linear(data[i + 1]!) + 0.0722 * linear(data[i + 2]!);
      low = Math.min(low, luminance);
      high = Math.max(high, luminance);
    }
    return (high + 0.05) / (low + 0.05);
  }, png.toString('base64'));

test('View_ButtonsOverAnyHead_AreSeen', async () => {
  const { page, errors } = await open('/view/demo', { sharp: true });
  await untilFace(page, 'playing');
  await page.evaluate(() => (document.querySelector<HTMLElement>('semblante-face')!.style.visibility = 'hidden'));
  const captions = page.getByRole('button', { name: 'Captions' });
  const { x, y, width, height } = (await captions.boundingBox())!;
  const clip = { x: x + width / 4, y: y + height / 4, width: width / 2, height: height / 2 }; // within the round button: its picture
  for (const colorScheme of ['light', 'dark'] as const) {
    await page.emulateMedia({ colorScheme });
    for (const behind of ['#f3c7b0', '#ffffff', '#8a5a3c', '#1a0f08']) {
      await page.evaluate((colour) => (document.body.style.background = colour), behind);
      expect(await contrastIn(page, await page.screenshot({ clip })), `${colorScheme}, over ${behind}`).toBeGreaterThanOrEqual(3);
    }
  }
  expect(errors).toEqual([]);
  await page.context().close();
});

test('View_WithoutWebGl_SaysSo', async () => {
  const { page } = await open('/view/demo', { noWebGl: true, locale: 'pt-BR' });
  await untilFace(page, 'error');
  expect((await shownFace(page)).message).toContain('não tem WebGL 2');
  await page.context().close();
});
