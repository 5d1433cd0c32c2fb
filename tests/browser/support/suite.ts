import type { Browser } from 'playwright-core';
import { afterAll, beforeAll } from 'vitest';
import { closeUsedPages } from './page_rest.ts';
import { within } from './patience.ts';
import { startServer, type RunningServer, type ServerOptions } from './server.ts';
import { launch, usual, type OpenOptions } from './studio_page.ts';

/** Of the test file that called `useStudio` or `useBrowser`, while its tests run. */
export let server: RunningServer;
export let browser: Browser;

/**
 * A browser starts in seconds, and its graphics compile their programs anew: one serves all files of a process, which run
 * one after the other.
 */
let started: Promise<Browser> | undefined;

async function sharedBrowser(): Promise<Browser> {
  const running = await started?.catch(() => undefined); // one that did not start is tried again by the next file
  if (!running?.isConnected()) started = launch();
  return started!;
}

/** Gives the tests of a file a browser without pages, but for those that rest, and closes them after. With arguments of Chromium it is the file's own. */
export function useBrowser(args: string[] = []): void {
  const isOwn = args.length > 0;
  beforeAll(async () => {
    browser = await (isOwn ? launch(args) : sharedBrowser());
  });
  afterAll(async () => {
    if (browser) await within('the pages are closed', isOwn ? browser.close() : closeUsedPages(browser));
  });
}

/** Gives the tests of a file a server too, and stops it after them. `lively`: what its pages are that do not state it. */
export function useStudio({ lively = false, ...options }: ServerOptions & Pick<OpenOptions, 'lively'> = {}, args: string[] = []): void {
  beforeAll(async () => {
    usual.lively = lively;
    server = await startServer(options);
  });
  afterAll(() => (usual.lively = false));
  afterAll(() => within('the server stops', Promise.resolve(server?.stop())));
  useBrowser(args); // hooks run backwards after the tests: the pages close before their server stops
}
