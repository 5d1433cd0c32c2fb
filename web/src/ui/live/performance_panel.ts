import { kindOfClip } from '../../face/clip_file.ts';
import { adviceFor, wordsOf } from '../../net/problem.ts';
import { absentChoice } from '../documents/absent_choice.ts';
import { h, redraw, replace, setOptions, setText } from '../shared/dom.ts';
import { exampleSelect } from '../documents/example_select.ts';
import { excerptBox } from '../documents/excerpt_box.ts';
import { fapWarnings } from '../documents/fap_warnings.ts';
import { chooseFile } from '../shared/file_button.ts';
import { formatTime } from '../shared/format.ts';
import { icon } from '../shared/icons.ts';
import { canIdle, setIdle } from '../shared/idle.ts';
import type { Toasts } from '../shared/toast.ts';
import { type LiveModel, streamOptions } from './live_model.ts';
import { capital } from '../shared/names.ts';
import type { PerformanceModel, Refusal } from './performance_model.ts';
import { serverWords, t } from '../../words/words.ts';

/** Plays a performance document or a .fap file into a stream, for this page and all other subscribers. */
export class PerformancePanel {
  readonly element: HTMLElement;
  private readonly script = h('div', { class: 'script' });
  private readonly transport = h('div', { class: 'transport' });
  private readonly trouble = h('div', { class: 'script-trouble' });
  private readonly target = h('select', { 'aria-label': t('Stream to play into') });
  private readonly from = h('input', {
    type: 'number',
    id: 'play-from',
    class: 'seconds',
    min: 0,
    step: 0.1,
    value: '0',
    'aria-label': t('Begin at, seconds'),
  });
  private readonly loop = h('input', { type: 'checkbox', id: 'play-loop' });
  private readonly clock = h('span', { class: 'number' });
  private readonly progress = h('input', {
    type: 'range',
    class: 'progress',
    min: 0,
    max: 1000,
    step: 1,
    'aria-label': t('Position'),
  });
  private readonly example: HTMLSelectElement;
  private held = false;

  constructor(
    private readonly model: PerformanceModel,
    live: LiveModel,
    private readonly toasts: Pick<Toasts, 'say'>,
  ) {
    this.example = exampleSelect((title, text) => this.model.choose({ kind: 'performance', title, text }));
    this.target.addEventListener('change', () => this.model.target.set(this.target.value));
    this.from.addEventListener('change', () => {
      this.model.from = Math.max(0, Math.round((Number(this.from.value) || 0) * 1000));
      this.from.value = String(this.model.from / 1000);
    });
    this.loop.addEventListener('change', () => (this.model.loop = this.loop.checked));
    this.progress.addEventListener('input', () => {
      this.held = true;
      this.showClock(Number(this.progress.value));
    });
    this.progress.addEventListener('change', () => {
      this.held = false;
      if (this.model.mine) void this.model.play({ from: Number(this.progress.value) });
    });
    this.element = h(
      'section',
      { class: 'performance' },
      h('header', { class: 'section-head' }, h('h2', {}, t('Performance'))),
      h(
        'div',
        { class: 'script-source' },
        chooseFile({
          label: t('Choose a .json or .fap file'),
          note: t('or drop it'),
          accept: '.json,.fap,application/json',
          take: ([file]) => void this.takeFile(file),
        }),
        this.example,
      ),
      this.script,
      h('label', { class: 'field-row' }, h('span', {}, t('Into')), this.target),
      h(
        'div',
        { class: 'play-options' },
        h('label', { class: 'field-row', for: 'play-from' }, h('span', {}, t('Begin at')), this.from, h('span', {}, 's')),
        h('label', { class: 'check', for: 'play-loop' }, this.loop, t('Loop')),
      ),
      this.transport,
      this.trouble,
    );
    const draw = (): void => redraw(this.transport, () => this.drawTransport());
    for (const signal of [model.script, model.absent, model.warnings])
      signal.watch(() => redraw(this.script, () => this.drawScript()));
    model.script.watch(draw);
    model.busy.watch(draw);
    model.refusal.watch((refusal) => this.drawTrouble(refusal));
    model.target.watch(() => this.drawTargets());
    live.streams.watch(() => this.drawTargets());
    let shown: string | undefined;
    model.playing.watch((playing) => {
      // A change of the position alone moves the slider only; redrawing the buttons would interrupt a click.
      const key = `${playing?.id ?? ''}:${String(model.mine)}`;
      if (key !== shown) draw();
      shown = key;
    });
  }

  async takeFile(file: File): Promise<void> {
    const text = await file.text();
    this.model.choose({ kind: kindOfClip(file.name, text), title: file.name, text });
  }

  /** Call a few times a second. */
  tick(): void {
    this.model.tick();
    if (this.model.playing.value && !this.held) this.showClock(this.model.position);
  }

  private showClock(position: number): void {
    const duration = this.model.playing.value?.duration ?? null;
    setText(this.clock, `${formatTime(position)} / ${duration === null ? '∞' : formatTime(duration)}`);
    this.progress.hidden = duration === null;
    if (duration === null) return;
    this.progress.max = String(Math.ceil(duration));
    if (!this.held) this.progress.value = String(Math.round(position));
    this.progress.style.setProperty('--to', `${duration > 0 ? Math.min(100, (position / duration) * 100) : 0}%`);
  }

  private drawScript(): void {
    const { model } = this;
    const script = model.script.value;
    replace(
      this.script,
      script
        ? h('div', { class: 'row' }, icon('film', 16), h('strong', { class: 'grow' }, script.title))
        : h('p', { class: 'muted small' }, t('A timeline of visemes, expressions, gaze and blinks, for all subscribers.')),
      script?.kind === 'fap' ? absentChoice(model.absent.value, (absent) => model.absent.set(absent)) : null,
      fapWarnings(model.warnings.value.map((warning) => `${capital(serverWords(warning))}.`)),
    );
  }

  private drawTargets(): void {
    setOptions(this.target, [['', t('Create a new stream')], ...streamOptions(this.model.ownStreams)], this.model.target.value);
  }

  private drawTransport(): void {
    const { model } = this;
    const playing = model.playing.value;
    const restart = playing !== null && model.mine;
    replace(
      this.transport,
      playing
        ? h(
            'div',
            { class: 'row' },
            h('span', { class: 'lamp lamp-open' }),
            h('strong', { class: 'grow' }, playing.name || t('Playing')),
            this.clock,
          )
        : null,
      playing ? this.progress : null,
      h(
        'div',
        { class: 'row' },
        this.playButton(playing !== null, restart),
        playing
          ? h(
              'button',
              { type: 'button', 'data-focus': 'stop', on: { click: () => void model.stop() } },
              icon('stop', 15),
              t('Stop'),
            )
          : null,
      ),
    );
    this.progress.disabled = !model.mine;
    if (playing) this.showClock(model.position);
  }

  private playButton(playing: boolean, restart: boolean): HTMLElement {
    const { model } = this;
    const button = h(
      'button',
      {
        type: 'button',
        class: playing ? '' : 'primary',
        'data-focus': 'play',
        disabled: model.busy.value,
        on: { click: () => void model.play() },
      },
      icon(restart ? 'reset' : 'play', 15),
      restart ? t('Play again') : t('Play'),
    );
    canIdle(button, this.toasts);
    const help = { label: t('Choose an example'), act: () => this.example.focus() };
    setIdle(button, t('Play'), model.script.value ? null : { why: t('There is nothing to play yet: choose an example or a file.'), help });
    return button;
  }

  private drawTrouble(refusal: Refusal | null): void {
    if (!refusal) return replace(this.trouble);
    const { problem, excerpt, holder } = refusal;
    // A 413 that a proxy makes has the advice for models, not for documents.
    const advice = holder === null && problem.status !== 413 ? adviceFor(problem) : null;
    replace(
      this.trouble,
      h(
        'div',
        { class: 'notice error', role: 'alert' },
        icon('warning', 16),
        h(
          'div',
          { class: 'grow' },
          h('strong', {}, holder ?? capital(wordsOf(problem))),
          problem.pointer ? h('p', {}, t('At '), h('code', {}, serverWords(problem.pointer))) : null,
          excerptBox(excerpt),
          advice ? h('p', {}, advice) : null,
          holder
            ? h(
                'button',
                { type: 'button', on: { click: () => void this.model.play({ take_over: true }) } },
                t('Take over'),
              )
            : null,
        ),
      ),
    );
  }
}
