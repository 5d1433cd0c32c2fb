import { h, setText } from '../shared/dom.ts';
import type { ChosenOptions, Parametrizer } from './parametrizer.ts';

interface Choice {
  value: string;
  title: string;
  note: string;
}

const weightChoices: readonly Choice[] = [
  { value: 'smooth', title: 'Smooth skin', note: 'Shares of the points fade out without steps: looks best.' },
  { value: 'paper', title: 'As in the paper', note: 'Weights exactly as published, Eq. 1 to 4.' },
];
const metricChoices: readonly Choice[] = [
  { value: 'edge', title: 'Along edges', note: 'The paper’s way, and the quickest.' },
  { value: 'unfolded', title: 'Across triangles', note: 'Nearer to the true distance over the skin.' },
];
const levelChoices: readonly Choice[] = [
  { value: 'auto', title: 'As suit the head', note: 'Some levels of fewer vertices, for phones and crowds.' },
  { value: 'none', title: 'None', note: 'The full mesh alone.' },
  { value: 'own', title: 'Own', note: 'The most vertices of each level, from many to few.' },
];

let boxes = 0;

/** How a head is to be parametrized. */
export class ParametrizeOptions {
  readonly element: HTMLElement;
  private readonly summary = h('span', { class: 'muted small grow' });
  private readonly number = (boxes += 1);
  private readonly budgets = h('input', {
    type: 'text',
    class: 'budgets',
    inputmode: 'numeric',
    value: '20000, 8000, 3000',
    'aria-label': 'The most vertices of each level',
    pattern: '\\s*\\d+(\\s*[,;\\s]\\s*\\d+)*\\s*',
    on: { change: () => this.setLevels('own') },
  });
  private readonly weights = this.field('Weights', weightChoices, (value) =>
    this.parametrizer.set({ weights: value as ChosenOptions['weights'] }),
  );
  private readonly metric = this.field('Distances', metricChoices, (value) =>
    this.parametrizer.set({ metric: value as ChosenOptions['metric'] }),
  );
  private readonly levels = this.field('Levels', levelChoices, (value) => this.setLevels(value));

  constructor(private readonly parametrizer: Parametrizer) {
    this.element = h(
      'details',
      { class: 'options' },
      h('summary', { class: 'small' }, h('span', {}, 'Options'), this.summary),
      this.weights.element,
      this.metric.element,
      this.levels.element,
      this.budgets,
    );
    parametrizer.options.watch((options) => {
      const levels = options.lods === 'auto' ? 'auto' : options.lods.length === 0 ? 'none' : 'own';
      const titles = [this.weights.show(options.weights), this.metric.show(options.metric)];
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
