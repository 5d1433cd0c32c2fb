import type { StreamSpeech } from '../../net/types.ts';
import { type LiveModel, streamOptions } from '../live/live_model.ts';
import { ask } from '../shared/dialog.ts';
import { h, redraw, replace, setOptions } from '../shared/dom.ts';
import { formatTime } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import { capital } from '../shared/names.ts';
import type { StreamSpeechModel } from './stream_speech_model.ts';
import { t } from '../../words/words.ts';

export interface StreamSpeechParts {
  model: StreamSpeechModel;
  live: LiveModel;
  /** Shows the recordings of a stream, this one opened. */
  showRecording: (stream: string, recording: string) => void;
}

let boxes = 0;

/** The stream that says a text, whether it is recorded, the button, and what becomes of it. */
export class StreamSpeechBox {
  readonly element: HTMLElement;
  private readonly target = h('select', { 'aria-label': t('Stream to speak in') });
  private readonly records: HTMLInputElement;
  private readonly status = h('div', { class: 'speak-status', 'aria-live': 'polite' });

  /** `make` gives what to say. */
  constructor(
    private readonly parts: StreamSpeechParts,
    private readonly make: () => Promise<StreamSpeech>,
  ) {
    const { model, live } = parts;
    boxes += 1;
    const id = `speak-records-${boxes}`;
    this.records = h('input', { type: 'checkbox', id, role: 'switch', on: { change: () => model.records.set(this.records.checked) } });
    this.target.addEventListener('change', () => model.target.set(this.target.value));
    this.element = h(
      'div',
      { class: 'speak-stream' },
      h('label', { class: 'field-row' }, h('span', {}, t('Stream')), this.target),
      h('label', { class: 'switch-row', for: id }, h('span', { class: 'grow' }, h('strong', {}, t('Record it'))), this.records),
      h(
        'button',
        { type: 'button', on: { click: () => void this.say() } },
        icon('live', 15),
        t('Speak into a stream'),
      ),
      h('p', { class: 'muted small' }, t('Everybody who watches the stream sees and hears it.')),
      this.status,
    );
    for (const signal of [live.streams, model.target]) signal.watch(() => this.drawStreams());
    model.records.watch((on) => (this.records.checked = on));
    model.state.watch(() => redraw(this.status, () => this.drawStatus()));
  }

  async say(): Promise<void> {
    const { model, live } = this.parts;
    const held = await model.say(this.make, false);
    if (held === null) return;
    const yes = await ask({
      title: t('Take {value} over?', { value: live.titleOf(model.target.value) }),
      text: `${capital(held)}.`,
      accept: t('Take over'),
      danger: true,
    });
    if (yes !== null) await model.say(this.make, true);
  }

  private drawStreams(): void {
    const { model, live } = this.parts;
    setOptions(this.target, [['', t('Create a new stream')], ...streamOptions(live.ownStreams)], model.target.value);
  }

  private drawStatus(): void {
    const { model, live } = this.parts;
    const state = model.state.value;
    if (state.kind === 'off') return replace(this.status);
    if (state.kind === 'starting') return replace(this.status, h('p', { class: 'muted' }, t('The voice is speaking…')));
    if (state.kind === 'failed') return replace(this.status, fault(state.message));
    if (state.kind === 'speaking') {
      const name = live.titleOf(state.stream);
      return replace(
        this.status,
        h(
          'div',
          { class: 'row' },
          h('span', { class: `lamp ${state.recording ? 'lamp-record' : 'lamp-open'}` }),
          h('strong', { class: 'grow' }, state.recording ? t('{name} speaks and is recorded', { name }) : t('{name} speaks', { name })),
          h('button', { type: 'button', class: 'small', 'data-focus': 'speak-end', on: { click: () => void model.stop() } }, icon('stop', 14), t('Stop')),
        ),
      );
    }
    const { recording, failure } = state;
    replace(
      this.status,
      failure === null ? null : fault(`${capital(failure)}.`),
      recording
        ? h(
            'div',
            { class: 'row' },
            h('strong', { class: 'grow' }, t('Recorded: {time}', { time: formatTime(recording.duration) })),
            h(
              'button',
              {
                type: 'button',
                class: 'small',
                'data-focus': 'speak-end',
                on: { click: () => this.parts.showRecording(recording.stream, recording.id) },
              },
              t('Show the recording'),
            ),
          )
        : failure === null ? h('p', { class: 'muted' }, t('Finished speaking.')) : null,
    );
  }
}

const fault = (message: string): HTMLElement =>
  h('div', { class: 'notice error', role: 'alert' }, icon('warning', 16), h('div', { class: 'grow' }, capital(message)));
