import { h } from './dom.ts';
import type { Activity } from './studio.ts';

/** A progress bar; indeterminate while the progress is unknown. */
export function progressBar(activity: Activity): HTMLElement {
  const percent = activity.progress === null ? null : Math.round(activity.progress * 100);
  const fill = h('span', {});
  if (percent !== null) fill.style.width = `${percent}%`;
  return h(
    'div',
    {
      class: `bar${percent === null ? ' unknown' : ''}`,
      role: 'progressbar',
      'aria-label': activity.title,
      'aria-valuemin': 0,
      'aria-valuemax': 100,
      'aria-valuenow': percent,
    },
    fill,
  );
}
