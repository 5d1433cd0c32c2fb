import { h, setText } from '../shared/dom.ts';
import type { ChosenOptions, Parametrizer } from './parametrizer.ts';

interface Choice {
  value: string;
  title: string;
  note: string;
}

const weightChoices: readonly Choice[] = [
  { value: 'smooth', title: 'Smooth skin', note: 'Weights fade out smoothly: looks best.' },
  {
    value: 'fitted',
    title: 'Fitted to its own shapes',
    note: 'Smooth weights, fitted to the morph targets of the model; a model without any is refused.',
  },
  { value: 'paper', title: 'As in the paper', note: 'Weights exactly as published, Eq. 1 to 4.' },
];
const metricChoices: readonly Choice[] = [
  { value: 'edge', title: 'Along edges', note: 'As in the paper; fastest.' },
  { value: 'unfolded', title: 'Across triangles', note: 'Closer to the true distance over the skin.' },
];
const ownArticulation = 'own';
const articulationChoices: readonly Choice[] = [
  {
    value: ownArticulation,
    title: 'Automatic',
    note: 'The jaw opens as far as in the shapes (morph targets) of the model; as usual if it has none.',
  },
  { value: '0.5', title: 'Quiet', note: 'The jaw opens half as far in speech.' },
  { value: '1', title: 'Usual', note: 'The jaw opens as far as that of an adult who talks.' },
  { value: '1.5', title: 'Clear', note: 'The jaw opens half as far again.' },
  { value: '2.5', title: 'Cartoon', note: 'The jaw opens two and a half times as far.' },
];
const expressionChoices: readonly Choice[] = [
  { value: 'library', title: 'Of the library', note: 'Visemes and expressions that fit every head.' },
  {
    value: 'own',
    title: 'Its own',
    note: 'Visemes and expressions of the model (its morph targets), where it has them.',
  },
];
const levelChoices: readonly Choice[] = [
  { value: 'auto', title: 'Automatic', note: 'Several levels with fewer vertices, for phones and crowds.' },
  { value: 'none', title: 'None', note: 'Only the full mesh.' },
  { value: 'own', title: 'Custom', note: 'The maximum number of vertices of each level, in descending order.' },
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
    'aria-label': 'Maximum number of vertices of each level',
    pattern: '\\s*\\d+(\\s*[,;\\s]\\s*\\d+)*\\s*',
    on: { change: () => this.setLevels('own') },
  });
  private readonly weights = this.field('Weights', weightChoices, (value) =>
    this.parametrizer.set({ weights: value as ChosenOptions['weights'] }),
  );
  private readonly metric = this.field('Distances', metricChoices, (value) =>
    this.parametrizer.set({ metric: value as ChosenOptions['metric'] }),
  );
  private readonly articulation = this.field('Articulation', articulationChoices, (value) =>
    this.parametrizer.setArticulation(value === ownArticulation ? null : Number(value)),
  );
  private readonly expressions = this.field('Expressions', expressionChoices, (value) =>
    this.parametrizer.set({ expressions: value as ChosenOptions['expressions'] }),
  );
  private readonly levels = this.field('Levels', levelChoices, (value) => this.setLevels(value));

  constructor(private readonly parametrizer: Parametrizer) {
    this.element = h(
      'details',
      { class: 'options' },
      h('summary', { class: 'small' }, h('span', {}, 'Options'), this.summary),
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
