import { expressions } from '@protocol/generated/mpeg4.ts';
import type { SpeechRequest, VoiceName } from '../../net/types.ts';
import { h, replace } from '../shared/dom.ts';
import { capital } from '../shared/names.ts';
import { Slider } from '../shared/slider.ts';
import { language, nameOf, t } from '../../words/words.ts';
import { voicesOf } from './voices_of.ts';

/** Languages with mouths of their own first; that of the page is chosen. */
const languages = [
  { tag: 'pt-BR', example: 'Olá, mundo! :) Papai bebe mamão.' },
  { tag: 'en', example: 'Hello, world! :) My baby bought a purple map.' },
  { tag: 'es', example: '¡Hola, mundo! :)' },
  { tag: 'fr', example: 'Bonjour, le monde ! :)' },
  { tag: 'de', example: 'Hallo, Welt! :)' },
  { tag: 'it', example: 'Ciao, mondo! :)' },
] as const;

/** A language as those who speak it write it. */
const ownName = (tag: string): string => capital(new Intl.DisplayNames([tag], { type: 'language' }).of(tag) ?? tag);

/** The fields of a text to say: the text, and how it is said. */
export class SpeechForm {
  readonly text: HTMLTextAreaElement;
  readonly choices: HTMLElement;
  private readonly language: HTMLSelectElement;
  private readonly voice = h('select', {});
  private readonly quality = h('p', { class: 'muted small' });
  private voices: readonly VoiceName[] = [];
  private readonly emotion: HTMLSelectElement;
  private readonly rate: Slider;

  /** `voices`: those of the server; without the list there is the voice program's own choice. `say`: Enter was pressed. */
  constructor(voices: Promise<readonly VoiceName[]>, say: () => void) {
    const own = languages.find(({ tag }) => tag === language) ?? languages[1];
    this.text = h('textarea', { rows: 3, maxlength: 20_000, 'aria-label': t('Text to say'), placeholder: own.example });
    this.text.addEventListener('keydown', (event) => {
      if (event.key === 'Enter' && !event.shiftKey && !event.isComposing) {
        event.preventDefault();
        say();
      }
    });
    this.language = h(
      'select',
      { on: { change: () => this.showLanguage() } },
      ...languages.map(({ tag }) => h('option', { value: tag, selected: tag === own.tag }, ownName(tag))),
    );
    this.emotion = h(
      'select',
      {},
      ...expressions.map(({ name }, number) =>
        h('option', { value: number === 0 ? 'neutral' : name }, number === 0 ? t('As the text says') : nameOf(capital(name))),
      ),
    );
    this.rate = new Slider({ label: t('Speed'), note: '%', min: 50, max: 200, value: 100, onInput: () => undefined });
    this.choices = h(
      'div',
      { class: 'speak-how' },
      h('div', { class: 'speak-choices' }, field(t('Language'), this.language), field(t('Emotion'), this.emotion), field(t('Voice'), this.voice)),
      this.quality,
      this.rate.element,
    );
    this.showLanguage();
    voices.then(
      (list) => {
        this.voices = list;
        this.showLanguage();
      },
      () => undefined,
    );
  }

  get languageTag(): string {
    return this.language.value;
  }

  get emotionName(): NonNullable<SpeechRequest['emotion']> {
    return this.emotion.value as NonNullable<SpeechRequest['emotion']>;
  }

  /** The text that was typed, or the example that is shown in its place. */
  get request(): SpeechRequest {
    return {
      text: this.text.value.trim() || this.text.placeholder,
      language: this.languageTag,
      voice: this.voice.value,
      emotion: this.emotionName,
      rate: this.rate.value / 100,
    };
  }

  /** Whether a voice speaks; a sound file has its own voice and speed. */
  setVoiced(voiced: boolean): void {
    this.rate.element.hidden = this.voice.disabled = !voiced;
  }

  /** The example, the voices and the quality of the language that is chosen. */
  private showLanguage(): void {
    const tag = this.language.value;
    this.text.placeholder = languages.find((one) => one.tag === tag)?.example ?? '';
    const fitting = voicesOf(this.voices, tag);
    replace(
      this.voice,
      h('option', { value: '' }, t('Default')),
      ...fitting.map(({ voice, label }) => h('option', { value: voice }, label || voice)),
    );
    this.quality.hidden = fitting[0]?.quality !== 'english';
    this.quality.textContent = t('Mouths in this language follow the chart of IPA and were not measured.');
  }
}

const field = (label: string, control: HTMLElement): HTMLElement => h('label', { class: 'field' }, h('span', {}, label), control);
