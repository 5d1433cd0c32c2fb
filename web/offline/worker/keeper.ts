import { keptHeader } from '../kept_header.ts';

/** What a service worker keeps, and under which address. */
export interface Keeping {
  cacheName: string;
  mostEntries: number;
  /** The address under which the answer to a request of this origin is kept; null: it is not kept. */
  keyOf(url: URL, page: boolean): string | null;
  /** ms that the network has before what is kept is shown; Infinity: only its failure counts. */
  patienceFor(url: URL, page: boolean): number;
  /** Kept addresses that a change (PUT, POST, ...) at this address may have made old. */
  madeOldBy(url: URL): (kept: URL) => boolean;
}

/** ms until an answer to a change has probably come. */
const changeTime = 1500;

const neverChanges = (url: URL): boolean => /\/assets\/[^/]+-[\w-]{8,}\.|\/v1\/artefacts\//.test(url.pathname);

/** Keeps answers of the server for the time without a network. The network comes first, except for files that never change. */
export function keepAnswers(worker: ServiceWorkerGlobalScope, keeping: Keeping): void {
  const keyOf = (request: Request): string | null => {
    const url = new URL(request.url);
    if (request.method !== 'GET' || url.origin !== worker.location.origin || url.search.includes('ticket=')) return null;
    url.hash = '';
    return keeping.keyOf(url, request.mode === 'navigate');
  };

  const keep = async (key: string, response: Response): Promise<void> => {
    if (response.status !== 200 || /no-store/.test(response.headers.get('Cache-Control') ?? '')) return;
    const cache = await caches.open(keeping.cacheName);
    await cache.put(key, response);
    const keys = await cache.keys(); // the oldest first
    await Promise.all(keys.slice(0, Math.max(0, keys.length - keeping.mostEntries)).map((old) => cache.delete(old)));
  };

  const answer = async (request: Request, key: string): Promise<Response> => {
    const cache = await caches.open(keeping.cacheName);
    const kept = await cache.match(key);
    if (kept && neverChanges(new URL(key))) return kept;
    const fresh = fetch(request).then((response) => {
      void keep(key, response.clone()).catch(() => undefined); // a full disk
      return response;
    });
    if (!kept) return fresh;
    const page = request.mode === 'navigate';
    const patience = keeping.patienceFor(new URL(key), page);
    const answers = [fresh];
    if (patience < Infinity) answers.push(new Promise<Response>((wake) => setTimeout(() => wake(kept), patience)));
    return Promise.race(answers).catch(() => (page ? kept : marked(kept)));
  };

  const askAgain = async (change: URL, isDeletion: boolean): Promise<void> => {
    await new Promise((wake) => setTimeout(wake, changeTime));
    const isOld = keeping.madeOldBy(change);
    const cache = await caches.open(keeping.cacheName);
    for (const { url } of await cache.keys())
      if (isDeletion && `${new URL(url).pathname}/`.startsWith(`${change.pathname}/`)) await cache.delete(url);
      else if (isOld(new URL(url))) await keep(url, await fetch(url)).catch(() => undefined);
  };

  worker.addEventListener('install', () => void worker.skipWaiting());
  worker.addEventListener('activate', (event) => event.waitUntil(worker.clients.claim()));
  worker.addEventListener('fetch', (event) => {
    const { request } = event;
    const key = keyOf(request);
    if (key !== null) event.respondWith(answer(request, key));
    else if (request.method !== 'GET') {
      // What a page sends while it closes is lost with the page unless the worker sends it.
      if (request.keepalive) event.respondWith(fetch(request));
      event.waitUntil(askAgain(new URL(request.url), request.method === 'DELETE'));
    }
  });
  worker.addEventListener('message', (event: ExtendableMessageEvent) => {
    const { keep: addresses, forget } = (event.data ?? {}) as { keep?: string[]; forget?: boolean };
    if (forget === true) event.waitUntil(caches.delete(keeping.cacheName));
    if (!Array.isArray(addresses)) return;
    const page = event.source instanceof WindowClient ? event.source.url.replace(/#.*/, '') : '';
    const learn = async (address: string): Promise<void> => {
      const url = new URL(address, worker.location.href);
      url.hash = '';
      if (url.origin !== worker.location.origin || url.search.includes('ticket=')) return;
      const key = keeping.keyOf(url, url.href === page);
      if (key === null || (await (await caches.open(keeping.cacheName)).match(key))) return;
      await keep(key, await fetch(url.href === page ? key : url, { cache: 'force-cache' })).catch(() => undefined);
    };
    event.waitUntil(Promise.all(addresses.slice(0, keeping.mostEntries).map(learn)));
  });
}

/** The page can tell that the server did not answer. */
function marked(kept: Response): Response {
  const headers = new Headers(kept.headers);
  headers.set(keptHeader, 'yes');
  return new Response(kept.body, { status: kept.status, statusText: kept.statusText, headers });
}
