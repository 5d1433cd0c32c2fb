import { h, setText } from '../shared/dom.ts';
import type { ChosenOptions, Parametrizer } from './parametrizer.ts';
import { t } from '../../words/words.ts';

interface Choice {
  value: string;
  title: string;
  note: string;
}

/** The kinds of weights, and the distances that they are computed from. */
export const weightChoices: readonly Choice[] = [
  { value: 'smooth', title: t('Smooth skin'), note: t('Weights fade out smoothly: looks best.') },
  {
    value: 'fitted',
    title: t('Fitted to its own shapes'),
    note: t('Smooth weights, fitted to the morph targets of the model; a model without any is refused.'),
  },
  { value: 'paper', title: t('As in the paper'), note: t('Weights exactly as published, Eq. 1 to 4.') },
];
export const metricChoices: readonly Choice[] = [
  { value: 'edge', title: t('Along edges'), note: t('As in the paper; fastest.') },
  { value: 'unfolded', title: t('Across triangles'), note: t('Closer to the true distance over the skin.') },
];
const ownArticulation = 'own';
const articulationChoices: readonly Choice[] = [
  {
    value: ownArticulation,
    title: t('Automatic'),
    note: t('The jaw opens as far as in the shapes (morph targets) of the model; as usual if it has none.'),
  },
  { value: '0.5', title: t('Quiet'), note: t('The jaw opens half as far in speech.') },
  { value: '1', title: t('Usual'), note: t('The jaw opens as far as that of an adult who talks.') },
  { value: '1.5', title: t('Clear'), note: t('The jaw opens half as far again.') },
  { value: '2.5', title: t('Cartoon'), note: t('The jaw opens two and a half times as far.') },
];
const expressionChoices: readonly Choice[] = [
  { value: 'library', title: t('Of the library'), note: t('Visemes and expressions that fit every head.') },
  {
    value: 'own',
    title: t('Its own'),
    note: t('Visemes and expressions of the model (its morph targets), where it has them.'),
  },
];
const levelChoices: readonly Choice[] = [
  { value: 'auto', title: t('Automatic'), note: t('Several levels with fewer vertices, for phones and crowds.') },
  { value: 'none', title: t('None'), note: t('Only the full mesh.') },
  { value: 'own', title: t('Custom'), note: t('The maximum number of vertices of each level, in descending order.') },
];

let boxes = 0;

/** The form of the parametrization options. */
export class ParametrizeOptions {
  readonly element: HTMLElement;
  private readonly summary = h('span', { class: 'muted small grow' });
  private readonly number = (boxes += 1);
  private readonly budgets = h('input', {
    type: 'text',
    class: 'budgets',
    inputmode: 'numeric',
    value: '20000, 8000, 3000',
    'aria-label': t('Maximum number of vertices of each level'),
    pattern: '\\s*\\d+(\\s*[,;\\s]\\s*\\d+)*\\s*',
    on: { change: () => this.setLevels('own') },
  });
  private readonly weights = this.field(t('Weights'), weightChoices, (value) =>
    this.parametrizer.set({ weights: value as ChosenOptions['weights'] }),
  );
  private readonly metric = this.field(t('Distances'), metricChoices, (value) =>
    this.parametrizer.set({ metric: value as ChosenOptions['metric'] }),
  );
  private readonly articulation = this.field(t('Articulation'), articulationChoices, (value) =>
    this.parametrizer.setArticulation(value === ownArticulation ? null : Number(value)),
  );
  private readonly expressions = this.field(t('Expressions'), expressionChoices, (value) =>
    this.parametrizer.set({ expressions: value as ChosenOptions['expressions'] }),
  );
  private readonly levels = this.field(t('Levels'), levelChoices, (value) => this.setLevels(value));

  constructor(private readonly parametrizer: Parametrizer) {
    this.element = h(
      'details',
      { class: 'options' },
      h('summary', { class: 'small' }, h('span', {}, t('Options')), this.summary),
      this.weights.element,
      this.metric.element,
      this.articulation.element,
      this.expressions.element,
      this.levels.element,
      this.budgets,
    );
    parametrizer.options.watch((options) => {
      const levels = options.lods === 'auto' ? 'auto' : options.lods.length === 0 ? 'none' : 'own';
      const titles = [this.weights.show(options.weights), this.metric.show(options.metric)];
      this.articulation.show(String(options.articulation ?? ownArticulation));
      this.expressions.show(options.expressions);
      this.levels.show(levels);
      this.budgets.hidden = levels !== 'own';
      setText(this.summary, titles.join(' · '));
    });
  }

  private setLevels(value: string): void {
    const own = (this.budgets.value.match(/\d+/g) ?? []).map(Number).sort((a, b) => b - a);
    this.parametrizer.set({ lods: value === 'auto' ? 'auto' : value === 'none' ? [] : own });
  }

  private field(
    label: string,
    choices: readonly Choice[],
    change: (value: string) => void,
  ): { element: HTMLElement; show: (value: string) => string } {
    const id = `${label.toLowerCase()}-${this.number}`;
    const note = h('p', { class: 'muted small' });
    const select = h(
      'select',
      { id },
      choices.map(({ value, title }) => h('option', { value }, title)),
    );
    select.addEventListener('change', () => change(select.value));
    return {
      element: h('div', { class: 'option' }, h('label', { for: id, class: 'muted' }, label), select, note),
      show: (value) => {
        select.value = value;
        const choice = choices.find((one) => one.value === value);
        setText(note, choice?.note ?? '');
        return choice?.title ?? '';
      },
    };
  }
}
