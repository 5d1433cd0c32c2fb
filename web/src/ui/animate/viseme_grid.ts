import { visemes } from '@protocol/generated/mpeg4.ts';
import { h } from '../shared/dom.ts';
import { rove } from '../shared/roving.ts';
import { t, visemeWords } from '../../words/words.ts';

export interface VisemeGridOptions {
  onChoose: (viseme: number) => void;
}

/** 15 buttons, each with its sounds and an example word. */
export class VisemeGrid {
  readonly element = h('div', { class: 'visemes', role: 'group', 'aria-label': t('Visemes') });
  private readonly buttons: HTMLButtonElement[] = [];

  constructor(options: VisemeGridOptions) {
    visemes.forEach((viseme, number) => {
      const sounds = number === 0 ? t('rest') : viseme.phonemes.join(' ');
      const words = visemeWords(viseme.name, viseme.examples);
      const button = h(
        'button',
        {
          type: 'button',
          class: 'viseme',
          'data-viseme': number,
          'aria-pressed': 'false',
          title: words.join(', '),
          on: { click: () => options.onChoose(number) },
        },
        h('span', { class: 'visually-hidden' }, `${t('Viseme {number}', { number })}: `),
        h('span', { class: 'sound' }, sounds),
        ' ',
        h('span', { class: 'word' }, words[0] ?? t('silence')),
      );
      this.buttons.push(button);
      this.element.append(button);
    });
    rove(this.element, 'button');
  }

  show(viseme: number | null): void {
    this.buttons.forEach((button, number) => button.setAttribute('aria-pressed', String(number === viseme)));
  }
}
