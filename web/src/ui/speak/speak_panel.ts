import type { Api } from '../../net/api.ts';
import type { RecordingRequest, Speech, StreamSpeech, Timeline } from '../../net/types.ts';
import { h, redraw, replace } from '../shared/dom.ts';
import { chooseFile } from '../shared/file_button.ts';
import { icon } from '../shared/icons.ts';
import { capital } from '../shared/names.ts';
import type { Signal } from '../shared/signal.ts';
import { serverWords, t } from '../../words/words.ts';
import { soundEndings } from './sound_files.ts';
import type { MicrophoneModel } from './microphone_model.ts';
import type { SpeakModel } from './speak_model.ts';
import type { SpeechForm } from './speech_form.ts';
import { wordsOf, type Word } from './spoken_words.ts';

/** The panel in which a text is typed, heard and seen. */
export class SpeakPanel {
  readonly element: HTMLElement;
  private readonly form: SpeechForm;
  private readonly said = h('div', { class: 'said', 'aria-live': 'polite' });
  private readonly recorded = h('div', { class: 'speak-recorded' });
  private readonly listening = h('div', { class: 'speak-listening', 'aria-live': 'polite' });
  /** A sound file in which somebody says the text, or what nobody typed; without, the voice says the text. */
  private recording: File | null = null;
  private words: { word: Word; element: HTMLElement }[] = [];

  constructor(
    private readonly model: SpeakModel,
    private readonly microphone: MicrophoneModel,
    private readonly api: Pick<Api, 'speechUrl' | 'createSpeechOfRecording'>,
    /** Makes the form, which says its text by this. */
    makeForm: (say: () => void) => SpeechForm,
    /** Lets a stream say what this gives. */
    intoStream: (make: () => Promise<StreamSpeech>) => HTMLElement,
  ) {
    this.form = makeForm(() => void this.say());
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
        this.form.text,
        h('button', { type: 'submit', class: 'primary' }, icon('play', 15), t('Speak')),
        this.recorded,
        this.form.choices,
      ),
      this.said,
      intoStream(() => this.forStream()),
      this.listening,
    );
    this.showRecording();
    for (const signal of [microphone.state, microphone.sendsVoice, microphone.voiceFault] as Signal<unknown>[])
      signal.watch(() => redraw(this.listening, () => this.drawListening()));
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
    this.form.text.focus();
  }

  private showRecording(): void {
    const { recording } = this;
    this.form.setVoiced(recording === null);
    replace(
      this.recorded,
      recording
        ? h(
            'div',
            { class: 'row' },
            h('span', { class: 'grow' }, t('Type what {name} says, for captions and the best mouth. If this stays empty, the mouth follows the sound alone.', { name: recording.name })),
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
            take: ([file]) => this.takeRecording(file),
          }),
    );
  }

  private removeRecording(): void {
    this.recording = null;
    this.showRecording();
    this.recorded.querySelector('button')?.focus();
  }

  /** For a stream: the text, or the recording made into a speech of the server. */
  private async forStream(): Promise<StreamSpeech> {
    const { form, recording } = this;
    if (!recording) return form.request;
    return { speech: (await this.api.createSpeechOfRecording(this.recordingOptions, recording)).id };
  }

  private get recordingOptions(): RecordingRequest {
    const text = this.form.text.value.trim();
    return { ...(text && { text }), language: this.form.languageTag, emotion: this.form.emotionName };
  }

  private say(): Promise<void> {
    const { form, recording } = this;
    return recording ? this.model.sayRecording(this.recordingOptions, recording) : this.model.say(form.request);
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
      state.kind === 'on' ? h('p', { class: 'muted small' }, t('The face says what you say, in any language. Sliders that are sent to a stream send the mouth too.')) : null,
      state.kind === 'on' ? this.voiceChoice() : null,
      state.kind === 'failed'
        ? h('div', { class: 'notice error', role: 'alert' }, icon('warning', 16), h('div', { class: 'grow' }, capital(state.message)))
        : null,
    );
  }

  /** Whether the voice goes with the mouth, and what that means. */
  private voiceChoice(): HTMLElement[] {
    const { microphone } = this;
    const fault = microphone.voiceFault.value;
    if (fault !== null) return [h('p', { class: 'muted small' }, fault)];
    const on = microphone.sendsVoice.value;
    const box = h('input', {
      type: 'checkbox',
      id: 'send-voice',
      role: 'switch',
      'data-focus': 'send-voice',
      checked: on,
      on: { change: () => void microphone.sendVoice(box.checked) },
    });
    return [
      h('label', { class: 'switch-row', for: 'send-voice' }, h('span', { class: 'grow' }, h('strong', {}, t('Send my voice too'))), box),
      h(
        'p',
        { class: 'muted small' },
        on
          ? t('Whoever watches the stream to which Live sends the sliders can hear you, and its recordings keep it.')
          : t('The sound stays on this page.'),
      ),
    ];
  }

  private drawSaid(): void {
    const state = this.model.state.value;
    this.words = [];
    if (state.kind === 'empty') return replace(this.said);
    if (state.kind === 'making') return replace(this.said, h('p', { class: 'muted' }, t('The voice is speaking…')));
    if (state.kind === 'failed')
      return replace(
        this.said,
        h('div', { class: 'notice error', role: 'alert' }, icon('warning', 16), h('div', { class: 'grow' }, capital(state.message))),
      );
    const { speech, timeline } = state;
    replace(
      this.said,
      this.drawWords(speech, timeline),
      ...speech.warnings.map((warning) => h('p', { class: 'muted small' }, `${capital(serverWords(warning))}.`)),
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
