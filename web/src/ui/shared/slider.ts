import { h } from './dom.ts';
import { t } from '../../words/words.ts';

export interface SliderOptions {
  label: string;
  /** Small text after the label. */
  note?: string;
  title?: string;
  min: number;
  max: number;
  step?: number;
  value?: number;
  onInput: (value: number) => void;
}

/**
 * A range input with its value beside it. The fill starts at zero; a double click resets to zero. One stop of the Tab key: a digit
 * that is typed on the range goes into the value.
 */
export class Slider {
  readonly element: HTMLElement;
  private readonly range: HTMLInputElement;
  private readonly number: HTMLInputElement;

  constructor(private readonly options: SliderOptions) {
    const { label, note, title, min, max, step = 1 } = options;
    this.range = h('input', {
      type: 'range',
      min,
      max,
      step,
      'aria-label': label,
      on: {
        input: () => this.take(Number(this.range.value)),
        dblclick: () => this.take(0),
        keydown: (event) => this.type(event),
      },
    });
    this.number = h('input', {
      type: 'number',
      min,
      max,
      step,
      'aria-label': t('{label}, value', { label }),
      tabindex: -1,
      on: {
        change: () => this.take(Number(this.number.value) || 0),
        keydown: (event) => {
          if (event.key === 'Enter' || event.key === 'Escape') this.range.focus();
        },
      },
    });
    this.element = h(
      'div',
      { class: 'slider', title: title ?? null },
      h('span', { class: 'slider-label' }, label, note ? h('small', {}, note) : null),
      this.number,
      this.range,
    );
    this.set(options.value ?? 0);
  }

  get value(): number {
    return Number(this.range.value);
  }

  /** Sets the displayed value without calling the listener. */
  set(value: number): void {
    const { min, max } = this.options;
    const shown = Math.round(value * 100) / 100;
    if (document.activeElement !== this.number) this.number.value = String(shown);
    this.range.value = String(value);
    const place = (at: number): number => Math.min(100, Math.max(0, ((at - min) / (max - min)) * 100));
    const zero = place(Math.min(Math.max(0, min), max));
    this.range.style.setProperty('--from', `${Math.min(zero, place(value))}%`);
    this.range.style.setProperty('--to', `${Math.max(zero, place(value))}%`);
    this.element.classList.toggle('moved', value !== 0);
  }

  /** Begins the value anew with a digit or sign; the browser writes it, since the focus is there by then. */
  private type({ key, ctrlKey, metaKey, altKey }: KeyboardEvent): void {
    if (!/^[\d-]$/.test(key) || ctrlKey || metaKey || altKey) return;
    this.number.focus();
    this.number.select();
  }

  private take(value: number): void {
    const bounded = Math.min(this.options.max, Math.max(this.options.min, value));
    this.set(bounded);
    this.options.onInput(bounded);
  }
}
