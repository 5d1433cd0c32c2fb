import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, expect, test } from 'vitest';
import { startServer, type RunningServer } from './support/server.ts';
import { launch, StudioPage } from './support/studio_page.ts';

let server: RunningServer;
let browser: Browser;

beforeAll(async () => {
  [server, browser] = await Promise.all([startServer(undefined, undefined, false), launch()]);
});
afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

test('Studio_ServerWithoutADemo_WaitsForNoStream', async () => {
  const studio = await StudioPage.open(browser, server.url);
  await studio.waitForStage('ready');
  const chip = studio.page.locator('.driver');
  await chip.getByText('By hand').waitFor();
  expect(await chip.getByRole('button').count()).toBe(0);
  expect(studio.errors).toEqual([]); // a request for a stream that is not there is one
  await studio.close();
});
