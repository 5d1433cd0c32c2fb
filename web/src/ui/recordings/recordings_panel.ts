import { wordsOf } from '../../net/problem.ts';
import type { Recording } from '../../net/types.ts';
import { ask } from '../shared/dialog.ts';
import { h, redraw, replace, setOptions, setText } from '../shared/dom.ts';
import { formatBytes, formatCount } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import { type LiveModel, streamOptions } from '../live/live_model.ts';
import { capital } from '../shared/names.ts';
import { recordingItem } from './recording_item.ts';
import type { RecordingsModel } from './recordings_model.ts';
import { needsFace } from '../shared/needs_face.ts';
import { progressBar } from '../shared/progress_bar.ts';
import type { Studio } from '../shared/studio.ts';
import { language, t } from '../../words/words.ts';

/** Starts recordings of streams and lists the recordings with their actions. */
export class RecordingsPanel {
  readonly element: HTMLElement;
  private readonly source = h('select', { 'aria-label': t('Stream to record') });
  private readonly target = h('select', { 'aria-label': t('Stream to play recordings into') });
  private readonly recorder = h('div', { class: 'recorder' });
  private readonly player = h('div', { class: 'recorder' });
  private readonly list = h('ul', { class: 'streams', 'aria-label': t('Recordings') });
  /** The elements that change every second, by id of a running recording. */
  private readonly running = new Map<string, HTMLElement>();
  private open: string | null = null;
  private drawn = '';

  constructor(
    private readonly model: RecordingsModel,
    private readonly live: LiveModel,
    private readonly studio: Studio,
  ) {
    this.source.addEventListener('change', () => model.stream.set(this.source.value));
    this.target.addEventListener('change', () => model.target.set(this.target.value));
    this.element = h(
      'section',
      { class: 'recordings' },
      h('header', { class: 'section-head' }, h('h2', {}, t('Recordings'))),
      h('label', { class: 'field-row' }, h('span', {}, t('Stream')), this.source),
      this.recorder,
      this.list,
      h('label', { class: 'field-row' }, h('span', {}, t('Play into')), this.target),
      this.player,
    );
    for (const signal of [live.streams, model.stream, model.target]) signal.watch(() => this.drawStreams());
    for (const signal of [model.recordings, model.busy, model.problem]) signal.watch(() => this.draw());
    // The lines contain stream titles, and the clip format depends on the selected head.
    for (const signal of [live.streams, model.stream, studio.selected]) signal.watch(() => this.draw());
  }

  /** Shows the recordings of a stream, this one opened. */
  reveal(stream: string, recording: string): void {
    this.open = recording;
    this.model.stream.set(stream);
    this.draw();
    this.element.scrollIntoView({ block: 'start' });
  }

  private drawStreams(): void {
    const all = [...streamOptions(this.live.streams.value ?? []), ['', t('All streams, including deleted ones')]] as const;
    setOptions(this.source, all, this.model.stream.value);
    setOptions(this.target, [['', t('Create a new stream')], ...streamOptions(this.live.ownStreams)], this.model.target.value);
    const into = this.live.ownStreams.find(({ id }) => id === this.model.target.value);
    const name = into?.playing?.kind === 'recording' ? into.playing.name || t('A recording') : null;
    redraw(this.player, () =>
      replace(
        this.player,
        name === null || !into
          ? null
          : h(
              'div',
              { class: 'row' },
              h('span', { class: 'lamp lamp-open' }),
              h('strong', { class: 'grow' }, t('{name} plays', { name })),
              h(
                'button',
                {
                  type: 'button',
                  class: 'small',
                  'data-focus': 'stop-playing',
                  'aria-label': t('Stop {name}', { name }),
                  on: { click: () => void this.model.stopPlaying() },
                },
                icon('stop', 14),
                t('Stop'),
              ),
            ),
      ),
    );
  }

  private draw(): void {
    const { running } = this.model;
    // A change of the counters alone must not redraw the list: that would interrupt a click or a drag.
    const resting = (this.model.recordings.value ?? []).filter(({ state }) => state !== 'recording');
    const clip = this.studio.selected.value?.state === 'parametrized';
    const { recordings, busy, problem, stream } = this.model;
    const titles = [...running, ...resting].map((recording) => this.live.titleOf(recording.stream));
    const facts = [running.map(({ id }) => id), resting, titles, recordings.value === null, stream.value, problem.value];
    const key = JSON.stringify([...facts, busy.value, this.open, clip]);
    if (key !== this.drawn) {
      this.drawn = key;
      redraw(this.recorder, () => this.drawRecorder(running));
      redraw(this.list, () => this.drawList(resting, clip));
    }
    for (const recording of running) this.count(recording);
  }

  private count({ id, created, duration, frames, bytes, lost }: Recording): void {
    const line = this.running.get(id);
    if (!line) return;
    const since = new Date(created).toLocaleTimeString(language, { timeStyle: 'short' });
    const words = [t('since {since}', { since }), `${formatCount(Math.round(duration / 1000))} s`, t('{frames} frames', { frames: formatCount(frames) }), formatBytes(bytes)];
    if (lost > 0) words.push(t('{lost} lost', { lost: formatCount(lost) }));
    setText(line, words.join(' · '));
  }

  private drawRecorder(running: readonly Recording[]): void {
    this.running.clear();
    const busy = this.model.busy.value === 'record';
    const line = (recording: Recording): HTMLElement => {
      const facts = h('span', { class: 'muted small number' });
      this.running.set(recording.id, facts);
      return h(
        'div',
        { class: 'row', role: 'status' },
        h('span', { class: 'lamp lamp-record' }),
        h(
          'div',
          { class: 'grow recording-words' },
          h('strong', {}, t('Recording {stream}', { stream: this.live.titleOf(recording.stream) })),
          facts,
        ),
        h(
          'button',
          {
            type: 'button',
            'data-focus': 'record',
            'aria-label': t('Stop recording {stream}', { stream: this.live.titleOf(recording.stream) }),
            disabled: busy,
            on: { click: () => void this.model.stop(recording) },
          },
          icon('stop', 15),
          t('Stop'),
        ),
      );
    };
    const ready = this.model.stream.value !== '' && this.model.recordings.value !== null;
    replace(
      this.recorder,
      running.map(line),
      running.length > 0
        ? null
        : h(
            'button',
            {
              type: 'button',
              class: 'record',
              'data-focus': 'record',
              disabled: busy || !ready,
              on: { click: () => void this.model.record() },
            },
            h('span', { class: 'lamp lamp-record' }),
            t('Record'),
          ),
      running.length === 0 && this.model.stream.value === ''
        ? this.streamAdvice()
        : null,
    );
  }

  private streamAdvice(): HTMLElement {
    const [first] = this.live.streams.value ?? [];
    return h(
      'p',
      { class: 'row small' },
      h('span', { class: 'grow muted' }, t('Choose one stream to record it.')),
      first
        ? h(
            'button',
            { type: 'button', class: 'small', 'data-focus': 'first', on: { click: () => this.model.stream.set(first.id) } },
            first.title || first.id,
          )
        : null,
    );
  }

  private drawList(recordings: readonly Recording[], clip: boolean): void {
    const { model } = this;
    if (model.problem.value) {
      replace(
        this.list,
        h(
          'li',
          { class: 'notice error' },
          icon('warning', 16),
          h('div', { role: 'alert' }, h('strong', {}, capital(wordsOf(model.problem.value))), h('p', {}, t('Retrying every few seconds.'))),
        ),
      );
      return;
    }
    if (model.recordings.value === null) return replace(this.list, h('li', {}, progressBar({ title: t('Loading recordings'), progress: null })));
    if (recordings.length === 0) return replace(this.list, h('li', { class: 'empty' }, t('Nothing recorded yet.')));
    const look = model.look.value;
    replace(
      this.list,
      recordings.map((recording) =>
        recordingItem(
          recording,
          {
            open: this.open === recording.id,
            busy: model.busy.value !== null,
            at: look?.id === recording.id ? look.at : null,
            stream: model.stream.value === '' ? this.live.titleOf(recording.stream) : null,
          },
          {
            play: () => void this.play(recording),
            remove: () => void this.remove(recording),
            download: (format) => void model.download(recording, format),
            look: (at) => void model.lookAt(recording, at),
            needsFace: (button) => needsFace(button, button.title, this.studio)(clip),
            toggle: () => {
              this.open = this.open === recording.id ? null : recording.id;
              this.draw();
            },
          },
        ),
      ),
    );
  }

  private async play(recording: Recording): Promise<void> {
    const held = await this.model.play(recording, false);
    if (held === null) return;
    const yes = await ask({
      title: t('Take {value} over?', { value: this.live.titleOf(this.model.target.value) }),
      text: `${capital(held)}.`,
      accept: t('Take over'),
      danger: true,
    });
    if (yes !== null) await this.model.play(recording, true);
  }

  private async remove(recording: Recording): Promise<void> {
    const yes = await ask({
      title: t('Delete {name}?', { name: recording.name }),
      text: t('It is permanently removed from the server.'),
      accept: t('Delete'),
      danger: true,
    });
    if (yes !== null) await this.model.remove(recording);
  }
}
