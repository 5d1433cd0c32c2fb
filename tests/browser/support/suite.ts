import type { Browser } from 'playwright-core';
import { afterAll, beforeAll } from 'vitest';
import { within } from './patience.ts';
import { startServer, type RunningServer, type ServerOptions } from './server.ts';
import { launch } from './studio_page.ts';

/** Of the test file that called `useStudio`, while its tests run. */
export let server: RunningServer;
export let browser: Browser;

/** A browser starts in seconds, and its graphics compile their programs anew: one serves all files, which run one after the other. */
let started: Promise<Browser> | undefined;

async function sharedBrowser(): Promise<Browser> {
  const running = await started?.catch(() => undefined); // one that did not start is tried again by the next file
  if (!running?.isConnected()) started = launch();
  return started!;
}

/** Gives the tests of a file a server and a browser without pages, and stops and closes them after. */
export function useStudio(options: ServerOptions = {}): void {
  beforeAll(async () => {
    [server, browser] = await Promise.all([startServer(options), sharedBrowser()]);
  });
  afterAll(async () => {
    await within('the pages are closed', Promise.all(browser?.contexts().map((context) => context.close()) ?? []));
    await within('the server stops', Promise.resolve(server?.stop()));
  });
}
