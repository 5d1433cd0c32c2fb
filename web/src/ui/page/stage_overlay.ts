import { formatList } from '../../net/model_formats.ts';
import { adviceFor } from '../../net/problem.ts';
import { h } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import type { SceneState } from '../stage/scene.ts';
import type { Activity } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** The card over the stage while no head is shown. */
export function overlayCard(
  state: SceneState,
  activity: Activity | undefined,
  again: (() => void) | null,
): HTMLElement | null {
  switch (state.kind) {
    case 'ready':
      return null;
    case 'empty':
      return h(
        'div',
        { class: 'stage-card' },
        icon('head', 40),
        h('h2', {}, t('No head on the stage')),
        h('p', {}, t('Choose one from the list, or drop a file ({formatList}) anywhere on this page.', { formatList })),
      );
    case 'loading': {
      const progress = activity?.progress ?? null;
      const percent = progress === null ? '' : ` ${Math.round(progress * 100)} %`;
      return h(
        'div',
        { class: 'stage-card', role: 'status' },
        h('div', { class: 'spinner', 'aria-hidden': 'true' }),
        h('p', {}, `${activity?.title ?? state.title}…${percent}`),
      );
    }
    case 'failed': {
      const { problem } = state;
      const advice = adviceFor(problem);
      return h(
        'div',
        { class: 'stage-card error', role: 'alert' },
        icon('warning', 32),
        h('h2', {}, problem.title),
        problem.detail ? h('p', {}, problem.detail) : null,
        problem.pointer ? h('code', {}, problem.pointer) : null,
        advice ? h('p', { class: 'advice' }, advice) : null,
        again ? h('button', { type: 'button', on: { click: again } }, t('Try again')) : null,
      );
    }
  }
}
