import { serverReached, tryServer, watchReach } from '../../net/reach.ts';
import { t } from '../../words/words.ts';
import { h } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';

/** ms between two questions whether the server is there again. */
const pause = 4000;

/** Says while the server cannot be reached what works and what does not; `back` is called when it is there again. */
export function offlineNote(base: string, back: () => void): HTMLElement {
  const words = h('p', {});
  const note = h('div', { class: 'offline-note', role: 'status' }, words);
  let away = false;
  watchReach((reached) => {
    if (away && reached) back();
    away = !reached;
    note.hidden = reached;
    words.replaceChildren(
      ...(reached
        ? []
        : [
            icon('warning', 16),
            h('strong', {}, t('No connection to the server.')),
            ' ',
            t('Heads opened in this browser before can be seen and animated. Points can be placed: they are kept here until they can be saved. ') +
              t('Uploading, parametrizing, speaking and streams need the server.'),
          ]),
    );
  });
  setInterval(() => {
    if (!serverReached()) void tryServer(base);
  }, pause);
  window.addEventListener('online', () => void tryServer(base));
  window.addEventListener('offline', () => void tryServer(base));
  return note;
}
