import { formatList } from '../../net/model_formats.ts';
import { adviceFor, titleOf } from '../../net/problem.ts';
import type { Problem } from '../../net/types.ts';
import { h } from '../shared/dom.ts';
import { formatPercent, withShortSizes } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import { capital } from '../shared/names.ts';
import { hasFinger } from '../shared/click_word.ts';
import type { SceneState } from '../stage/scene.ts';
import type { Activity, ShelfState } from '../shared/studio.ts';
import { serverWords, t } from '../../words/words.ts';

/** What the card needs beside the state of the stage. */
export interface OverlayFacts {
  activity: Activity | undefined;
  /** Opens the shown head again; null when that cannot help. */
  again: (() => void) | null;
  shelf: ShelfState;
  /** Whether the server has heads. */
  heads: boolean;
  reload: () => void;
  upload: () => void;
  /** Takes the head that could not be read from the list; null: none is open. */
  remove: (() => void) | null;
  /** Adds the sample head. */
  addSample: () => void;
}

/** The card over the stage while no head is shown. */
export function overlayCard(state: SceneState, facts: OverlayFacts): HTMLElement | null {
  switch (state.kind) {
    case 'ready':
      return null;
    case 'empty':
      if (facts.shelf.kind === 'failed') return failure(facts.shelf.problem, facts.reload);
      return facts.shelf.kind === 'loading' ? waiting(t('Asking the server for heads')) : invitation(facts);
    case 'loading': {
      const progress = facts.activity?.progress ?? null;
      return waiting(facts.activity?.title ?? state.title, progress === null ? '' : ` ${formatPercent(progress)}`);
    }
    case 'failed':
      return failure(state.problem, facts.again, facts.remove && [uploadButton(facts, 'primary'), h('button', { type: 'button', on: { click: facts.remove } }, t('Take it off the list'))]);
  }
}

const uploadButton = ({ upload }: OverlayFacts, look: string): HTMLElement =>
  h('button', { type: 'button', class: look, on: { click: upload } }, t('Upload a head'));

function invitation(facts: OverlayFacts): HTMLElement {
  const { heads, addSample } = facts;
  const finger = hasFinger();
  const words = heads
    ? finger
      ? t('Choose one from the list, or upload a file ({formatList}).', { formatList })
      : t('Choose one from the list, or drop a file ({formatList}) anywhere on this page.', { formatList })
    : finger
      ? t('Upload a file ({formatList}). Then place its points and press a button, and it talks.', { formatList })
      : t('Drop a file ({formatList}) anywhere on this page. Then place its points and press a button, and it talks.', { formatList });
  return h(
    'div',
    { class: 'stage-card' },
    icon('head', 40),
    h('h2', {}, heads ? t('No head on the stage') : t('No heads yet.')),
    h('p', {}, words),
    h(
      'div',
      { class: 'row wrap' },
      uploadButton(facts, heads ? '' : 'primary'),
      heads ? null : h('button', { type: 'button', on: { click: addSample } }, t('Try the sample head')),
    ),
  );
}

// Progress is said by ui/page/progress_said.ts, not by this card, which is drawn again at each step.
const waiting = (title: string, progress = ''): HTMLElement =>
  h(
    'div',
    { class: 'stage-card' },
    h('div', { class: 'spinner', 'aria-hidden': 'true' }),
    h('p', {}, `${title}…${progress}`),
  );

function failure(problem: Problem, again: (() => void) | null, others: HTMLElement[] | null = null): HTMLElement {
  const advice = adviceFor(problem);
  const detail = withShortSizes(serverWords(problem.detail ?? ''));
  return h(
    'div',
    { class: 'stage-card error', role: 'alert' },
    icon('warning', 32),
    h('h2', {}, titleOf(problem)),
    problem.detail ? h('p', {}, problem.pointer ? [h('code', {}, serverWords(problem.pointer)), ' ', detail] : capital(detail)) : null,
    advice ? h('p', { class: 'advice' }, advice) : null,
    again ? h('button', { type: 'button', on: { click: again } }, t('Try again')) : null,
    others ? h('div', { class: 'row wrap' }, others) : null,
  );
}
