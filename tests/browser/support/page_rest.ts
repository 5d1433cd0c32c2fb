import type { Browser, CDPSession, Page } from 'playwright-core';

/**
 * What changes a page or its context for the rest of its life: a test that calls one of these has the page for itself. Size, permissions
 * and the page's routes, which tests change too, are put back.
 */
const lasting = {
  page: ['addInitScript', 'emulateMedia', 'exposeBinding', 'exposeFunction', 'setExtraHTTPHeaders'],
  context: ['addCookies', 'addInitScript', 'exposeBinding', 'exposeFunction', 'newCDPSession', 'route', 'setExtraHTTPHeaders', 'setGeolocation', 'setOffline'],
};

const heard = ['console', 'dialog', 'download', 'pageerror', 'request', 'requestfailed', 'requestfinished', 'response', 'websocket', 'worker'] as const;

/** Pages at rest in a browser: each keeps a process. */
const mostAtRest = 4;

interface Resting {
  kind: string;
  page: Page;
}

const resting = new WeakMap<Browser, Resting[]>();
const lastingOf = new WeakMap<Page, { isChanged: boolean; devtools: CDPSession }>();

/** Closes all pages of a browser but those at rest. */
export async function closeUsedPages(browser: Browser): Promise<void> {
  const atRest = new Set((resting.get(browser) ?? []).map(({ page }) => page.context()));
  await Promise.all(browser.contexts().map((context) => (atRest.has(context) ? undefined : context.close())));
}

/** The page of this kind that rested last, for another test. */
export function takeRested(browser: Browser, kind: string): Page | undefined {
  const pages = (resting.get(browser) ?? []).filter(({ page }) => !page.isClosed());
  resting.set(browser, pages);
  const at = pages.map((one) => one.kind).lastIndexOf(kind);
  return at < 0 ? undefined : pages.splice(at, 1)[0]!.page;
}

/** Notes from now on what changes a new page for good. */
export async function watchForRest(page: Page): Promise<void> {
  const context = page.context();
  const state = { isChanged: false, devtools: await context.newCDPSession(page) };
  lastingOf.set(page, state);
  const note = (object: object, names: readonly string[]): void => {
    const methods = object as Record<string, (...given: unknown[]) => unknown>;
    for (const name of names) {
      const method = methods[name]!.bind(object);
      methods[name] = (...given) => {
        state.isChanged = true;
        return method(...given);
      };
    }
  };
  note(page, lasting.page);
  note(context, lasting.context);
}

/**
 * Lets a page rest until a test opens one of its kind; false: it cannot, as a test changed it for good or its server is gone. The studio in
 * a page of a new context takes twice the processor's time of the same in a page that is there: a window, a process, scripts that are
 * compiled anew. A page at rest has nothing of an earlier test: neither storage nor cookies, permissions, routes and listeners.
 */
export async function rest(page: Page, kind: string, size: { width: number; height: number }): Promise<boolean> {
  const context = page.context();
  const state = lastingOf.get(page);
  if (!state || state.isChanged || page.isClosed() || context.pages().length !== 1 || !page.url().startsWith('http')) return false;
  for (const event of heard) page.removeAllListeners(event);
  await page.unrouteAll({ behavior: 'ignoreErrors' });
  // A small file of the same server: at an empty address the page would lose its process.
  const { origin } = new URL(page.url());
  const isThere = await page.goto(`${origin}/favicon.svg`, { timeout: 10_000 }).then((answer) => answer?.ok() ?? false, () => false);
  if (!isThere) return false;
  await page.evaluate(() => {
    localStorage.clear();
    sessionStorage.clear();
  });
  await state.devtools.send('Storage.clearDataForOrigin', { origin, storageTypes: 'indexeddb,local_storage,cache_storage' });
  await Promise.all([context.clearCookies(), context.clearPermissions(), page.setViewportSize(size), page.mouse.move(0, 0)]);
  const pages = [...(resting.get(context.browser()!) ?? []), { kind, page }];
  resting.set(context.browser()!, pages);
  if (pages.length > mostAtRest) await pages.shift()!.page.context().close();
  return true;
}
