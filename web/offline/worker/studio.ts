/** The service worker of the studio: keeps the page and the heads that were opened, so that they can be seen without a network. */
import { keepAnswers } from './keeper.ts';

const worker = self as unknown as ServiceWorkerGlobalScope;
const home = new URL('./', worker.location.href);

const pageFile = /^(assets\/.+|draco\/.+|view\/icon[^/]*|[^/]+\.(wasm|svg|webmanifest))$/;
const headFile = /^v1\/(models(\/[^/]+(\/(preview\.glb|report\.json|feature-points|rig\.json|weights|mesh\.drc))?)?|artefacts\/[^/]+)$/;

keepAnswers(worker, {
  cacheName: 'semblante-studio-1',
  mostEntries: 400,
  keyOf: (url, page) => {
    if (!url.href.startsWith(home.href)) return null;
    const path = url.pathname.slice(home.pathname.length);
    if (page) return path === '' || path === 'index.html' ? home.href : null;
    return pageFile.test(path) || headFile.test(path) ? url.href : null;
  },
  // Old points must not stand for new ones because the server is busy.
  patienceFor: (url) => (url.pathname.includes('/v1/') ? Infinity : 4000),
  madeOldBy: (change) => {
    const head = /\/v1\/models\/([^/]+)/.exec(change.pathname)?.[1];
    return ({ pathname }) =>
      head !== undefined &&
      (pathname.endsWith('/v1/models') || pathname.endsWith(`/v1/models/${head}`) || pathname.endsWith(`/v1/models/${head}/feature-points`));
  },
});
