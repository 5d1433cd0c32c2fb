import { h } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import type { SpeechForm } from './speech_form.ts';
import { StreamSpeechBox, type StreamSpeechParts } from './stream_speech_box.ts';
import { t } from '../../words/words.ts';

/** The panel in which a text is typed that a stream says. */
export class StreamSpeechPanel {
  readonly element: HTMLElement;

  constructor(makeForm: (say: () => void) => SpeechForm, parts: StreamSpeechParts) {
    const form = makeForm(() => void box.say());
    const box = new StreamSpeechBox(parts, () => Promise.resolve(form.request));
    this.element = h(
      'section',
      { class: 'speak' },
      h('header', { class: 'section-head' }, h('h2', {}, t('Speak'))),
      h('div', { class: 'speak-form' }, form.text, h('details', { class: 'reasons' }, h('summary', { class: 'small' }, icon('chevron', 14), t('Language, emotion, voice, speed')), form.choices)),
      box.element,
    );
  }
}
