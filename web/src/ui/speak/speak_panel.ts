import { expressions } from '@protocol/generated/mpeg4.ts';
import type { Api } from '../../net/api.ts';
import type { Speech, SpeechRequest, Timeline, VoiceName } from '../../net/types.ts';
import { h, redraw, replace } from '../shared/dom.ts';
import { chooseFile } from '../shared/file_button.ts';
import { icon } from '../shared/icons.ts';
import { capital } from '../shared/names.ts';
import { Slider } from '../shared/slider.ts';
import { language, nameOf, t } from '../../words/words.ts';
import { soundEndings } from './sound_files.ts';
import type { MicrophoneModel } from './microphone_model.ts';
import type { SpeakModel } from './speak_model.ts';
import { wordsOf, type Word } from './spoken_words.ts';
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

/** The panel in which a text is typed, heard and seen. */
export class SpeakPanel {
  readonly element: HTMLElement;
  private readonly text: HTMLTextAreaElement;
  private readonly language: HTMLSelectElement;
  private readonly voice = h('select', {});
  private readonly quality = h('p', { class: 'muted small' });
  private voices: readonly VoiceName[] = [];
  private readonly emotion: HTMLSelectElement;
  private readonly rate: Slider;
  private readonly said = h('div', { class: 'said', 'aria-live': 'polite' });
  private readonly recorded = h('div', { class: 'speak-recorded' });
  private readonly listening = h('div', { class: 'speak-listening', 'aria-live': 'polite' });
  /** A sound file in which somebody says the text, or what nobody typed; without, the voice says the text. */
  private recording: File | null = null;
  private words: { word: Word; element: HTMLElement }[] = [];

  constructor(
    private readonly model: SpeakModel,
    private readonly microphone: MicrophoneModel,
    private readonly api: Pick<Api, 'speechUrl' | 'voices'>,
  ) {
    const own = languages.find(({ tag }) => tag === language) ?? languages[1];
    this.text = h('textarea', { rows: 3, maxlength: 20_000, 'aria-label': t('Text to say'), placeholder: own.example });
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
    this.element = h(
      'section',
      { class: 'speak' },
      h('header', { class: 'section-head' }, h('h2', {}, t('Speak')), h('span', { class: 'muted small' }, t('on this page only'))),
      h(
        'form',
        {
          class: 'speak-form',
          on: {
            submit: (event) => {
              event.preventDefault();
              void this.say();
            },
          },
        },
        this.text,
        h('button', { type: 'submit', class: 'primary' }, icon('play', 15), t('Speak')),
        this.recorded,
        h('div', { class: 'speak-choices' }, field(t('Language'), this.language), field(t('Emotion'), this.emotion), field(t('Voice'), this.voice)),
        this.quality,
        this.rate.element,
      ),
      this.said,
      this.listening,
    );
    this.text.addEventListener('keydown', (event) => {
      if (event.key === 'Enter' && !event.shiftKey && !event.isComposing) {
        event.preventDefault();
        void this.say();
      }
    });
    this.showRecording();
    this.showLanguage();
    // Without the list there is the voice program's own choice.
    api.voices().then(
      (voices) => {
        this.voices = voices;
        this.showLanguage();
      },
      () => undefined,
    );
    microphone.state.watch(() => redraw(this.listening, () => this.drawListening()));
    model.state.watch(() => this.draw());
    model.playing.watch((playing) => {
      this.draw();
      if (playing) this.follow();
    });
  }

  /** A sound file in which somebody speaks; the text is typed, unless it is there already or is to be heard. */
  takeRecording(file: File): void {
    this.recording = file;
    this.showRecording();
    this.text.focus();
  }

  private showRecording(): void {
    const { recording } = this;
    const speed = this.rate.element;
    speed.hidden = this.voice.disabled = recording !== null;
    replace(
      this.recorded,
      recording
        ? h(
            'div',
            { class: 'row' },
            h('span', { class: 'grow' }, t('Type what {name} says, for captions and the best mouth. Left empty, it is heard.', { name: recording.name })),
            h(
              'button',
              { type: 'button', on: { click: () => this.removeRecording() }, 'aria-label': t('Remove the recording') },
              icon('close', 15),
            ),
          )
        : chooseFile({
            label: t('Your own recording'),
            note: t('or drop it'),
            accept: ['audio/*', ...soundEndings].join(','),
            take: (file) => this.takeRecording(file),
          }),
    );
  }

  private removeRecording(): void {
    this.recording = null;
    this.showRecording();
    this.recorded.querySelector('button')?.focus();
  }

  private say(): Promise<void> {
    const emotion = this.emotion.value as NonNullable<SpeechRequest['emotion']>;
    if (this.recording) {
      const text = this.text.value.trim();
      return this.model.sayRecording({ ...(text && { text }), language: this.language.value, emotion }, this.recording);
    }
    return this.model.say({
      text: this.text.value.trim() || this.text.placeholder,
      language: this.language.value,
      voice: this.voice.value,
      emotion,
      rate: this.rate.value / 100,
    });
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
    this.quality.textContent = t('Mouths are those of English: this language has no table of its own.');
  }

  /** Lights up the word that is heard, until the sound stops. */
  private follow(): void {
    const position = this.model.position;
    for (const { word, element } of this.words)
      element.classList.toggle('now', this.model.playing.value && position >= word.time && position < word.end);
    if (this.model.playing.value) requestAnimationFrame(() => this.follow());
  }

  private draw(): void {
    redraw(this.said, () => this.drawSaid());
  }

  private drawListening(): void {
    const { microphone } = this;
    const state = microphone.state.value;
    const on = state.kind === 'on' || state.kind === 'asking';
    replace(
      this.listening,
      h(
        'button',
        {
          type: 'button',
          'data-focus': 'microphone',
          'aria-pressed': String(on),
          on: { click: () => (on ? microphone.stop() : void microphone.start()) },
        },
        icon(on ? 'stop' : 'microphone', 15),
        on ? t('Stop the microphone') : t('Use the microphone'),
      ),
      state.kind === 'asking' ? h('p', { class: 'muted small' }, t('The browser asks for the microphone…')) : null,
      state.kind === 'on'
        ? h('p', { class: 'muted small' }, t('The face says what you say, in any language. The sound stays on this page; sliders that are sent to a stream send the mouth too.'))
        : null,
      state.kind === 'failed'
        ? h('div', { class: 'notice error', role: 'alert' }, icon('warning', 16), h('div', { class: 'grow' }, state.message))
        : null,
    );
  }

  private drawSaid(): void {
    const state = this.model.state.value;
    this.words = [];
    if (state.kind === 'empty') return replace(this.said);
    if (state.kind === 'making') return replace(this.said, h('p', { class: 'muted' }, t('The voice is speaking…')));
    if (state.kind === 'failed')
      return replace(
        this.said,
        h('div', { class: 'notice error', role: 'alert' }, icon('warning', 16), h('div', { class: 'grow' }, state.message)),
      );
    const { speech, timeline } = state;
    replace(
      this.said,
      this.drawWords(speech, timeline),
      ...speech.warnings.map((warning) => h('p', { class: 'muted small' }, `${capital(warning)}.`)),
      h(
        'div',
        { class: 'row speak-files' },
        this.playButton(),
        h('span', { class: 'grow' }),
        this.download(speech, 'audio', 'WAV', 'speech.wav'),
        this.download(speech, 'captions', 'VTT', 'speech.vtt'),
        this.download(speech, 'performance', 'JSON', 'speech.json'),
      ),
    );
  }

  private drawWords(speech: Speech, timeline: Timeline): HTMLElement {
    const line = h('p', { class: 'said-words', lang: speech.request.language });
    for (const piece of wordsOf(speech.text, timeline)) {
      if (typeof piece === 'string') {
        line.append(piece);
        continue;
      }
      const element = h('span', { class: 'said-word' }, piece.text);
      this.words.push({ word: piece, element });
      line.append(element);
    }
    return line;
  }

  private playButton(): HTMLElement {
    const playing = this.model.playing.value;
    return h(
      'button',
      {
        type: 'button',
        'data-focus': 'play',
        on: { click: () => (playing ? this.model.stop() : void this.model.play()) },
      },
      icon(playing ? 'stop' : 'play', 15),
      playing ? t('Stop') : t('Again'),
    );
  }

  private download(speech: Speech, file: 'audio' | 'captions' | 'performance', label: string, name: string): HTMLElement {
    return h(
      'a',
      { href: this.api.speechUrl(speech.id, file), download: name, 'aria-label': t('Download {name}', { name }) },
      icon('download', 15),
      label,
    );
  }
}

const field = (label: string, control: HTMLElement): HTMLElement => h('label', { class: 'field' }, h('span', {}, label), control);
