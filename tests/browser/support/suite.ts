import type { Browser } from 'playwright-core';
import { afterAll, beforeAll } from 'vitest';
import { within } from './patience.ts';
import { startServer, type RunningServer, type ServerOptions } from './server.ts';
import { launch } from './studio_page.ts';

/** Of the test file that called `useStudio`, while its tests run. */
export let server: RunningServer;
export let browser: Browser;

/** Starts a server and a browser before the tests of a file, and stops them after. */
export function useStudio(options: ServerOptions = {}): void {
  beforeAll(async () => {
    [server, browser] = await Promise.all([startServer(options), launch()]);
  });
  afterAll(async () => {
    await within('the browser is closed', Promise.resolve(browser?.close()));
    await within('the server stops', Promise.resolve(server?.stop()));
  });
}
