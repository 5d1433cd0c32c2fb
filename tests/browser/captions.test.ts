import { join } from 'node:path';
import type { Browser, BrowserContext, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, expect, test } from 'vitest';
import { untilFace } from './support/face_page.ts';
import { patience } from './support/patience.ts';
import { root } from './support/paths.ts';
import { startServer, type RunningServer } from './support/server.ts';
import { launch } from './support/studio_page.ts';

/** What a stream says, as words on the page that shows its face. The server's voice, of tones, gives the times. */
let server: RunningServer;
let browser: Browser;
beforeAll(async () => {
  [server, browser] = await Promise.all([startServer({ demo: false, voice: join(root, 'server/voice/examples/beeps.py') }), launch()]);
});
afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

const ask = (method: string, path: string, body?: object): Promise<Response> =>
  fetch(server.url + path, {
    method,
    ...(body ? { headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body) } : {}),
  });

afterEach(async () => {
  await ask('DELETE', '/v1/streams/talk');
  for (const context of browser.contexts()) await context.close();
});

async function open(context: BrowserContext, options = ''): Promise<{ page: Page; got: (type: number) => number }> {
  context.setDefaultTimeout(patience);
  const page = await context.newPage();
  const received: number[] = [];
  page.on('websocket', (socket) => socket.on('framereceived', ({ payload }) => received.push(Buffer.from(payload)[0]!)));
  await page.goto(`${server.url}/view/talk${options}`, { waitUntil: 'domcontentloaded', timeout: patience });
  await untilFace(page, 'resting', 'playing');
  return { page, got: (type) => received.filter((first) => first === type).length };
}

const say = (text: string, language = 'en'): Promise<Response> => ask('POST', '/v1/streams/talk/speech', { text, language, seed: 7 });
const words = (page: Page): ReturnType<Page['locator']> => page.locator('semblante-face .captions span');
const button = (page: Page): ReturnType<Page['locator']> => page.getByRole('button', { name: 'Captions' });

/** Where the lower lip is drawn and where the words begin, px from the upper edge; also how far words reach beyond the page. */
function places(page: Page): Promise<{ lip: number; top: number; outside: number }> {
  return page.evaluate(() => {
    interface Inside {
      camera: { matrix: Float32Array };
      face: { rig: { feature_points: { id: string; position: number[] | null }[] } };
    }
    const element = document.querySelector('semblante-face')!;
    const { camera, face } = (element as unknown as { show: Inside }).show;
    const [x, y, z] = face.rig.feature_points.find(({ id }) => id === '8.2')!.position as [number, number, number];
    const row = (i: number): number => camera.matrix[i]! * x + camera.matrix[4 + i]! * y + camera.matrix[8 + i]! * z + camera.matrix[12 + i]!;
    const box = element.shadowRoot!.querySelector('.captions span')!.getBoundingClientRect();
    return {
      lip: ((1 - row(1) / row(3)) / 2) * element.clientHeight,
      top: box.top,
      outside: Math.max(-box.left, box.right - innerWidth, box.bottom - innerHeight),
    };
  });
}

test('Captions_AreShownWhenAskedFor_AndTheChoiceIsRemembered', async () => {
  expect((await ask('POST', '/v1/streams', { name: 'talk', model: 'sample' })).status).toBe(201);
  const context = await browser.newContext({ viewport: { width: 390, height: 844 } });
  const { page, got } = await open(context);
  expect(await button(page).getAttribute('aria-pressed')).toBe('false');
  const { id } = (await (await say('Nobody reads this.')).json()) as { id: string };
  await expect.poll(() => page.evaluate(() => (window as unknown as { semblanteFace: { state: string } }).semblanteFace.state)).toBe('playing');
  expect(got(13)).toBe(0);
  await button(page).click();
  expect(await button(page).getAttribute('aria-pressed')).toBe('true');
  await ask('DELETE', `/v1/streams/talk/performances/${id}`);
  expect((await say('Bom dia a todos vocês. Que bom que vieram, mamãe!', 'pt-BR')).status).toBe(202);
  await words(page).filter({ hasText: 'Bom dia a todos vocês.' }).waitFor();
  expect(await words(page).getAttribute('lang')).toBe('pt-BR');
  expect(await words(page).getAttribute('aria-live')).toBe('polite'); // nothing is heard
  await words(page).filter({ hasText: 'Que bom que vieram, mamãe!' }).waitFor();
  await expect.poll(() => words(page).textContent(), { timeout: patience }).toBe('');

  const again = await open(context);
  expect(await button(again.page).getAttribute('aria-pressed')).toBe('true');
  await say('Once more.');
  await words(again.page).filter({ hasText: 'Once more.' }).waitFor();
  await button(again.page).click();
  await expect.poll(() => words(again.page).textContent()).toBe('');
});

test('Captions_OfWhoComesLate_AreThoseThatAreSaid', async () => {
  await ask('POST', '/v1/streams', { name: 'talk', model: 'sample' });
  const long = 'This sentence is long enough that somebody comes in the middle of it, and it goes on for some more time, and then for more, until it ends.';
  await say(long);
  const context = await browser.newContext({ viewport: { width: 390, height: 844 } });
  await context.addInitScript(() => localStorage.setItem('semblante.captions', 'on'));
  const { page } = await open(context);
  await expect.poll(() => words(page).textContent(), { timeout: patience }).not.toBe('');
  expect(long).toContain(await words(page).textContent());
});

test('Captions_OfARecording_ComeAgain', async () => {
  await ask('POST', '/v1/streams', { name: 'talk', model: 'sample' });
  const { id } = (await (await ask('POST', '/v1/streams/talk/recordings', { name: 'Take' })).json()) as { id: string };
  await say('What is kept is read again.');
  const playing = async (): Promise<unknown> => ((await (await ask('GET', '/v1/streams/talk')).json()) as { playing?: unknown }).playing ?? null;
  await expect.poll(playing, { timeout: patience, interval: 200 }).toBe(null);
  expect((await ask('POST', `/v1/recordings/${id}/stop`)).status).toBe(200);
  const context = await browser.newContext({ viewport: { width: 390, height: 844 } });
  await context.addInitScript(() => localStorage.setItem('semblante.captions', 'on'));
  const { page } = await open(context);
  expect((await ask('POST', '/v1/streams/talk/plays', { recording: id })).status).toBe(202);
  await words(page).filter({ hasText: 'What is kept is read again.' }).waitFor();
  await ask('DELETE', `/v1/recordings/${id}`);
});

test.each([
  ['portrait', 390, 844],
  ['landscape', 844, 390],
  ['wide', 1440, 900],
  ['small', 320, 568],
])('Captions_%s_LeaveTheMouthFree_AndStayOnThePage', async (_, width, height) => {
  await ask('POST', '/v1/streams', { name: 'talk', model: 'sample' });
  const context = await browser.newContext({ viewport: { width, height } });
  await context.addInitScript(() => localStorage.setItem('semblante.captions', 'on'));
  const { page } = await open(context);
  for (const [text, language] of [
    ['Donaudampfschifffahrtselektrizitätenhauptbetriebswerkbauunterbeamtengesellschaft ist ein langes Wort.', 'de'],
    ['مرحبا بكم جميعا في هذا اليوم الجميل، ونتمنى لكم وقتا طيبا معنا.', 'ar'],
  ] as const) {
    await expect.poll(async () => (await say(text, language)).status, { timeout: patience }).toBe(202);
    await expect.poll(() => words(page).textContent(), { timeout: patience }).toContain(text.slice(0, 5));
    const { lip, top, outside } = await places(page);
    expect(lip).toBeGreaterThan(height * 0.3);
    expect(top).toBeGreaterThan(lip);
    expect(outside).toBeLessThanOrEqual(0);
    await expect.poll(() => words(page).textContent(), { timeout: patience }).toBe('');
  }
});
