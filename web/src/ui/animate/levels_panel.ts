import type { FitReport, LevelError, PackageLevel } from '../../net/types.ts';
import { h, redraw, replace } from '../shared/dom.ts';
import type { FitModel } from '../fit/fit_model.ts';
import { formatBytes, formatCount } from '../shared/format.ts';
import type { SceneView } from '../stage/scene.ts';
import type { Studio } from '../shared/studio.ts';
import { t } from '../../words/words.ts';

/** The levels of detail of the open face: size and error of each, and which one is on the stage. */
export class LevelsPanel {
  readonly element: HTMLElement;
  private readonly body = h('div', {});

  constructor(
    private readonly studio: Studio,
    private readonly fit: FitModel,
    private readonly scene: SceneView,
  ) {
    this.element = h(
      'section',
      { class: 'levels-section' },
      h(
        'header',
        { class: 'section-head' },
        h('h2', {}, t('Levels of detail')),
        h('span', { class: 'muted small' }, t('for slow devices')),
      ),
      this.body,
    );
    const draw = (): void => redraw(this.body, () => this.draw());
    studio.selected.watch(draw);
    fit.report.watch(draw);
    scene.level.watch(draw);
  }

  private draw(): void {
    const model = this.studio.selected.value;
    const levels = model?.package?.levels ?? [];
    this.element.hidden = model?.state !== 'parametrized';
    const state = this.fit.report.value;
    const told = state.kind === 'ready' ? state.report.levels_of_detail : undefined;
    replace(
      this.body,
      levels.length > 1
        ? h(
            'ul',
            { class: 'levels' },
            levels.map((level) => this.row(level, told)),
          )
        : h('p', { class: 'muted small' }, t('Only the full mesh: it is small already, or no levels were requested.')),
      told?.missed.map(({ words }) =>
        h('p', { class: 'muted small' }, `${words.charAt(0).toUpperCase()}${words.slice(1)}.`),
      ),
    );
  }

  private row(level: PackageLevel, told: FitReport['levels_of_detail']): HTMLElement {
    const bytes = (level.artefacts['mesh.drc']?.bytes ?? 0) + (level.artefacts.weights?.bytes ?? 0);
    const error = told?.levels.find(({ lod }) => lod === level.lod);
    return h(
      'li',
      {},
      h(
        'button',
        {
          type: 'button',
          class: 'level',
          'data-level': level.lod,
          'data-focus': `level-${level.lod}`,
          'aria-pressed': String(this.scene.level.value === level.lod),
          on: { click: () => this.scene.showLevel(level.lod) },
        },
        h('strong', { class: 'grow' }, level.lod === 0 ? t('Full mesh') : t('Level {lod}', { lod: level.lod })),
        h('span', { class: 'number' }, t('{vertices} vertices · {bytes}', { vertices: formatCount(level.vertices), bytes: formatBytes(bytes) })),
        error ? h('small', { class: 'muted' }, errorWords(error)) : null,
      ),
    );
  }
}

/** "Error at most 0.4 % of the eye distance, in expressions 0.9 % of the eye distance". */
function errorWords({
  neutral,
  expressions,
}: {
  neutral: LevelError;
  expressions: Record<string, LevelError>;
}): string {
  const worst = (error: LevelError): number => error.of_es0?.max ?? error.max;
  const word = (value: number): string =>
    neutral.of_es0 ? t('{number} % of the eye distance', { number: Number((value * 100).toPrecision(2)) }) : t('{number} units', { number: Number(value.toPrecision(2)) });
  const faces = Object.values(expressions).map(worst);
  const still = word(worst(neutral));
  return faces.length > 0
    ? t('Error at most {still}, in expressions {faces}', { still, faces: word(Math.max(...faces)) })
    : t('Error at most {still}', { still });
}
