import type { Finding, FitReport } from '../../net/types.ts';
import type { FitModel } from './fit_model.ts';
import type { Parametrizer } from '../points/parametrizer.ts';
import { h, setText } from '../shared/dom.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

type Move = NonNullable<Finding['move']>;

/** Where the fit doctor would move points because of errors and warnings; of two places for one point, that of the worse finding. */
export function movesOf({ findings }: FitReport): Move[] {
  const moves = new Map<string, Move>();
  for (const severity of ['error', 'warning']) {
    for (const { move, severity: own } of findings) if (move && own === severity && !moves.has(move.point)) moves.set(move.point, move);
  }
  return [...moves.values()];
}

/** A button that moves all points to where the fit doctor would have them and parametrizes the head again; hidden while there are none. */
export function mendButton(studio: Studio, fit: FitModel, parametrizer: Parametrizer): HTMLButtonElement {
  let moves: Move[] = [];
  const button = h('button', { type: 'button', class: 'small mend', on: { click: () => void parametrizer.mend(moves) } });
  const draw = (): void => {
    const { report } = fit;
    const model = studio.selected.value;
    moves = report.value.kind === 'ready' && model?.state === 'parametrized' ? movesOf(report.value.report) : [];
    button.hidden = moves.length === 0;
    button.disabled = model !== null && studio.activities.value.has(model.id);
    const [first] = moves;
    setText(button, moves.length === 1 ? t('Move point {point} and parametrize again', { point: first!.point }) : t('Move {count} points and parametrize again', { count: moves.length }));
  };
  for (const signal of [fit.report, studio.selected, studio.activities]) signal.watch(draw);
  return button;
}
