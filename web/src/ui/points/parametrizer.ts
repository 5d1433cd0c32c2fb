import { problemOf } from '../../net/problem.ts';
import type { Finding, ParametrizationOptions } from '../../net/types.ts';
import { countWords } from '../shared/finding_words.ts';
import type { PointsModel } from './points_model.ts';
import { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/**
 * These options are always sent: the server's defaults follow the paper and make no levels of detail. Without an
 * articulation the server takes that of the head's own shapes.
 */
export type ChosenOptions = Required<Omit<ParametrizationOptions, 'weight_bits' | 'articulation'>> &
  Pick<ParametrizationOptions, 'articulation'>;

/** Starts parametrizations with the chosen options and reports the outcome. */
export class Parametrizer {
  readonly options = new Signal<ChosenOptions>({
    weights: 'smooth',
    metric: 'edge',
    expressions: 'library',
    lods: 'auto',
  });

  constructor(
    private readonly studio: Studio,
    private readonly points: PointsModel,
  ) {}

  set(change: Partial<ChosenOptions>): void {
    this.options.set({ ...this.options.value, ...change });
  }

  /** Null: that of the head's own shapes. */
  setArticulation(articulation: number | null): void {
    const { articulation: _, ...others } = this.options.value;
    this.options.set(articulation === null ? others : { ...others, articulation });
  }

  /** Moves points to where the fit doctor would have them, saves and parametrizes. */
  async mend(moves: readonly NonNullable<Finding['move']>[]): Promise<void> {
    this.points.moveAll(moves.map(({ point, vertex, position }) => [point, { vertex, position }]));
    await this.run();
  }

  async run(): Promise<void> {
    const { studio, points } = this;
    const model = studio.selected.value;
    if (!model) return;
    if (points.draft.changes > 0 && !(await points.save())) return studio.tab.set('points');
    try {
      if (!(await studio.parametrize(model, this.options.value))) return;
      const now = studio.models.value.find((one) => one.id === model.id) ?? model;
      const found = now.findings ? countWords(now.findings) : '';
      studio.toasts.say(t('{name} is ready to animate.', { name: now.name }) + (found === '' ? '' : t(' The fit doctor found {found}.', { found })));
      if (studio.selected.value?.id === now.id) studio.tab.set('animate'); // errors are told there too (ui/animate/errors_notice.ts)
    } catch (error) {
      points.show(error);
      if (points.problems.size > 0) studio.tab.set('points');
      studio.toasts.problem(t('The head was not parametrized'), problemOf(error));
    }
  }
}
