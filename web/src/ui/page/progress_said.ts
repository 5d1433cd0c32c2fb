import { t } from '../../words/words.ts';
import { h, setText } from '../shared/dom.ts';
import { formatPercent } from '../shared/format.ts';
import type { Studio } from '../shared/studio.ts';
import type { SceneView } from '../stage/scene.ts';

/** Parts of a progress that are said: each change of a percentage would drown everything else. */
const parts = 4;

/** Says what is going on and how far it is to those who do not see the bars. */
export function progressSaid(studio: Studio, scene: SceneView): HTMLElement {
  const said = h('p', { class: 'visually-hidden', role: 'status' });
  let going = false;
  const draw = (): void => {
    const activities = [...studio.activities.value.values()].map(({ title, progress }) =>
      progress === null ? title : `${title}, ${formatPercent(Math.floor(progress * parts) / parts)}`,
    );
    const state = scene.state.value;
    if (activities.length === 0 && state.kind === 'loading') activities.push(state.title);
    if (activities.length > 0) setText(said, activities.join('. '));
    else if (going && state.kind !== 'failed') setText(said, t('Done.'));
    going = activities.length > 0;
  };
  studio.activities.watch(draw);
  scene.state.watch(draw);
  return said;
}
