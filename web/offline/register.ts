/**
 * Registers a service worker, which keeps this page and its faces for the time without a network. What was loaded before
 * it was there is named to it; the browser's cache has it.
 */
export function keepOffline(): void {
  if (!('serviceWorker' in navigator)) return;
  const start = async (): Promise<void> => {
    await navigator.serviceWorker.register(new URL('worker.js', location.href));
    const { active } = await navigator.serviceWorker.ready;
    // An upload is listed as well, by an address that cannot be read; it was answered by another status.
    const resources = performance.getEntriesByType('resource') as PerformanceResourceTiming[];
    const loaded = resources.filter(({ responseStatus }) => responseStatus === 200 || !responseStatus).map(({ name }) => name);
    const named = [...document.querySelectorAll<HTMLLinkElement>('link[href]')].map(({ href }) => href);
    active?.postMessage({ keep: [location.href, ...named, ...loaded] });
  };
  // The larger level and the images come first; a refusal (no TLS) leaves the page as it is.
  setTimeout(() => void start().catch(() => undefined), 4000);
}

/** Lets the service worker forget what it has kept: the next user of this browser may be another one. */
export async function forgetKept(): Promise<void> {
  const registration = await navigator.serviceWorker?.getRegistration();
  registration?.active?.postMessage({ forget: true });
}
