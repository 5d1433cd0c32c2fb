/**
 * The service worker of /view/: keeps the page and the face packages that were shown, so that they open without a network.
 * The network comes first, except for files whose name has the hash of their content.
 */
const worker = self as unknown as ServiceWorkerGlobalScope;

const cacheName = 'semblante-view-1';
/** ms that the network has before the kept page is shown */
const patience = 4000;
const mostEntries = 120;

worker.addEventListener('install', () => void worker.skipWaiting());
worker.addEventListener('activate', (event) => event.waitUntil(worker.clients.claim()));

/** Pages of all streams are one file. */
function keyOf(request: Request): string {
  const url = new URL(request.url);
  if (request.mode === 'navigate') url.pathname = url.pathname.replace(/\/view\/[^/]*$/, '/view/');
  url.hash = '';
  return url.href;
}

const neverChanges = (url: URL): boolean => /\/assets\/[^/]+-[\w-]{8,}\.|\/v1\/artefacts\//.test(url.pathname);

function isKept(request: Request): boolean {
  const url = new URL(request.url);
  if (request.method !== 'GET' || url.origin !== worker.location.origin || url.search.includes('ticket=')) return false;
  return (
    request.mode === 'navigate' ||
    /\/(assets|view)\/|\/v1\/artefacts\/|\/v1\/models\/[^/]+\/(rig\.json|weights|mesh\.drc)$|\/v1\/streams\/[^/]+$/.test(url.pathname)
  );
}

async function keep(key: string, response: Response): Promise<void> {
  if (response.status !== 200 || /no-store/.test(response.headers.get('Cache-Control') ?? '')) return;
  const cache = await caches.open(cacheName);
  await cache.put(key, response);
  const keys = await cache.keys(); // the oldest first
  await Promise.all(keys.slice(0, Math.max(0, keys.length - mostEntries)).map((old) => cache.delete(old)));
}

async function answer(request: Request): Promise<Response> {
  const key = keyOf(request);
  const kept = await caches.match(key);
  if (kept && neverChanges(new URL(key))) return kept;
  const fresh = fetch(request).then((response) => {
    void keep(key, response.clone()).catch(() => undefined); // a full disk
    return response;
  });
  if (!kept) return fresh;
  const late = new Promise<Response>((wake) => setTimeout(() => wake(kept), patience));
  return Promise.race([fresh, late]).catch(() => kept);
}

worker.addEventListener('fetch', (event) => {
  if (isKept(event.request)) event.respondWith(answer(event.request));
});

worker.addEventListener('message', (event: ExtendableMessageEvent) => {
  const { keep: addresses } = (event.data ?? {}) as { keep?: string[] };
  if (!Array.isArray(addresses)) return;
  event.waitUntil(
    Promise.all(
      addresses.slice(0, mostEntries).map(async (address) => {
        const url = new URL(address, worker.location.href);
        if (/\/view\/[^/.]*$/.test(url.pathname)) url.pathname = url.pathname.replace(/[^/]*$/, '');
        const request = new Request(url, { cache: 'force-cache' });
        if (!isKept(request) || (await caches.match(keyOf(request)))) return;
        await keep(keyOf(request), await fetch(request)).catch(() => undefined);
      }),
    ).then(() => undefined),
  );
});
