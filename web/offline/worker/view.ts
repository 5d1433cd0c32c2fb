/** The service worker of /view/: keeps the page and the face packages that were shown, so that they open without a network. */
import { keepAnswers } from './keeper.ts';

keepAnswers(self as unknown as ServiceWorkerGlobalScope, {
  cacheName: 'semblante-view-1',
  mostEntries: 120,
  keyOf: (url, page) => {
    // Pages of all streams are one file.
    if (page) return url.href.replace(/\/view\/[^/]*$/, '/view/');
    const kept = /\/(assets|view)\/|\/v1\/artefacts\/|\/v1\/models\/[^/]+\/(rig\.json|weights|mesh\.drc)$|\/v1\/streams\/[^/]+$/;
    return kept.test(url.pathname) ? url.href : null;
  },
  patienceFor: () => 4000,
  madeOldBy: () => () => false,
});
