import type { Direction, Model, ModelFrame } from '../../net/types.ts';
import { h, redraw, replace } from '../shared/dom.ts';
import type { PointsModel } from './points_model.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

type Axes = ModelFrame['axes'];
export type QuarterTurn = 'stand' | 'turn' | 'roll';

/** The axes after a quarter turn of the head: its front goes up, its left side to the front, or its left side up. Together they reach all 24. */
export function quarterTurned({ up, front }: Axes, turn: QuarterTurn): Axes {
  const left = cross(up, front);
  switch (turn) {
    case 'stand':
      return { up: front, front: opposite(up) };
    case 'turn':
      return { up, front: left };
    case 'roll':
      return { up: left, front };
  }
}

/** Whether only the user can tell how this head stands: points are proposed, and the camera placed, for one that stands. */
export const standsUncertain = (model: Model | null): boolean =>
  model?.state === 'ready' && model.frame !== null && !model.frame.sure.axes && !model.frame.by_user.axes;

/** Asks, before the first point is placed, whether a head stands upright when its file does not tell, and turns it by quarters. */
export function uprightBox(studio: Studio, points: PointsModel): HTMLElement {
  const box = h('div', { class: 'notice upright', hidden: true });
  const turns: readonly { turn: QuarterTurn; title: string }[] = [
    { turn: 'stand', title: t('Tip back') },
    { turn: 'turn', title: t('Turn') },
    { turn: 'roll', title: t('Roll') },
  ];
  /** The head that is being turned: the question stays until it is answered. */
  let turned = '';
  const send = async (axes: Axes): Promise<void> => {
    const { value: model } = studio.selected;
    if (model) await studio.setFrame(model, { up: axes.up, front: axes.front });
  };
  /** The next step of who has said that a head stands right. */
  const begin = (id: string): void => {
    if (studio.selected.value?.id === id && studio.tab.value === 'points' && points.chosen.value === null) points.chooseFirst();
  };
  const draw = (): void => {
    const model = studio.selected.value;
    const asks = model !== null && points.draft.points.size === 0 && (standsUncertain(model) || turned === model.id);
    box.hidden = !asks;
    if (!asks || !model?.frame) return;
    const { axes } = model.frame;
    const disabled = model.state !== 'ready' || studio.activities.value.has(model.id);
    const button = (title: string, key: string, click: () => void): HTMLElement =>
      h('button', { type: 'button', class: 'small', 'data-focus': key, disabled, on: { click } }, title);
    redraw(box, () =>
      replace(
        box,
        h('p', {}, t('Is it upright, and does it look at you?')),
        h(
          'div',
          { class: 'row wrap tight' },
          button(t('Yes'), 'yes', () => {
            turned = '';
            if (standsUncertain(model)) void send(axes).then(() => begin(model.id));
            else {
              draw();
              begin(model.id);
            }
          }),
          ...turns.map(({ turn, title }) =>
            button(title, turn, () => {
              turned = model.id;
              void send(quarterTurned(axes, turn));
            }),
          ),
        ),
      ),
    );
  };
  studio.selected.watch(draw);
  studio.activities.watch(draw);
  points.changed.watch(draw);
  return box;
}

const opposite = (direction: Direction): Direction => `${direction.startsWith('+') ? '-' : '+'}${direction.slice(1)}` as Direction;

/** The cross product of two directions along different axes. */
function cross(a: Direction, b: Direction): Direction {
  const axes = 'XYZ';
  const [i, j] = [axes.indexOf(a[1]!), axes.indexOf(b[1]!)];
  const product = `+${axes[3 - i - j]!}` as Direction;
  const isCyclic = (i + 1) % 3 === j;
  return isCyclic === (a[0] === b[0]) ? product : opposite(product);
}
