import { expressions, faps, visemes } from '@protocol/generated/mpeg4.ts';
import { endOf, numberOfViseme, targetOf, type Cue, type CueTarget } from '../../face/cue_sheet.ts';
import { h, replace } from '../shared/dom.ts';
import { formatTime } from '../shared/format.ts';
import { icon, type IconName } from '../shared/icons.ts';
import { canIdle, setIdle, type Idle } from '../shared/idle.ts';
import { capital, fapTitle } from '../shared/names.ts';
import { dragCue, type CuePart } from './cue_drag.ts';
import { lettersScale } from '../shared/rem.ts';
import type { Toasts } from '../shared/toast.ts';
import { TimelineModel } from './timeline_model.ts';
import { visemeTitle } from './viseme_title.ts';
import { nameOf, t } from '../../words/words.ts';

/** More cues than these are not drawn: each is a control of the page. */
const mostCues = 3000;
/** Pixels of a second at letters of the usual size, as `gripWidth`. */
const scales = [20, 40, 80, 160, 320];
/** Width of a cue's edge that lengthens it, pixels. */
const edge = 8;
/** Width of a grip beside the chosen cue, as in timeline.css. */
const gripWidth = 44;
const newCueLength = 400;

export interface TimelineOptions {
  model: TimelineModel;
  /** The position of the playback, ms. */
  position: () => number;
  seek: (position: number) => void;
  save: () => void;
  toasts: Pick<Toasts, 'say'>;
}

/** The cues of a performance on tracks: moved, lengthened, added and deleted by pointer and keyboard. */
export class Timeline {
  readonly element = h('div', { class: 'timeline' });
  private readonly tracks = h('div', { class: 'timeline-tracks' });
  private readonly playhead = h('div', { class: 'timeline-playhead' });
  private readonly scroll = h('div', { class: 'timeline-scroll', role: 'group', 'aria-label': t('Cues') });
  private readonly start = h('input', { type: 'number', class: 'seconds', min: 0, step: 0.05 });
  private readonly end = h('input', { type: 'number', class: 'seconds', min: 0, step: 0.05 });
  private readonly kind: HTMLSelectElement;
  private readonly undo = this.button('undo', t('Undo'), () => this.options.model.undo());
  private readonly redo = this.button('redo', t('Redo'), () => this.options.model.redo());
  private readonly remove = this.button('trash', t('Delete the cue'), () => this.options.model.remove());
  private readonly nearer = this.button('plus', t('Zoom in'), () => this.zoom(1));
  private readonly farther = this.button('minus', t('Zoom out'), () => this.zoom(-1));
  private scale = 2;
  private grips: HTMLElement[] = [];
  private buttons = new Map<number, HTMLButtonElement>();

  constructor(private readonly options: TimelineOptions) {
    const { model } = options;
    this.kind = h('select', { 'aria-label': t('Kind of cue') }, kinds());
    this.start.addEventListener('change', () => {
      const cue = model.cues[model.chosen.value];
      const start = Number(this.start.value) * 1000;
      if (cue) model.place(start, start + endOf(cue) - cue.time);
    });
    this.end.addEventListener('change', () => {
      const cue = model.cues[model.chosen.value];
      if (cue) model.place(cue.time, Number(this.end.value) * 1000);
    });
    canIdle(this.remove, options.toasts);
    this.scroll.append(this.tracks);
    this.element.append(
      this.scroll,
      h(
        'div',
        { class: 'row wrap timeline-tools' },
        this.undo,
        this.redo,
        this.remove,
        this.farther,
        this.nearer,
        h('span', { class: 'grow' }),
        h('button', { type: 'button', on: { click: options.save } }, icon('download', 15), t('Save')),
      ),
      h(
        'div',
        { class: 'row wrap timeline-tools' },
        h('label', { class: 'field-row' }, h('span', {}, t('From, s')), this.start),
        h('label', { class: 'field-row' }, h('span', {}, t('To, s')), this.end),
      ),
      h(
        'div',
        { class: 'row timeline-tools' },
        this.kind,
        h('button', { type: 'button', on: { click: () => this.add() } }, icon('plus', 15), t('Add here')),
      ),
    );
    this.element.addEventListener('keydown', (event) => this.key(event));
    model.document.watch(() => this.draw());
    model.chosen.watch(() => this.showChosen());
  }

  /** Call a few times a second. */
  tick(): void {
    this.playhead.style.left = `${this.x(this.options.position())}px`;
  }

  private get pixelsPerSecond(): number {
    return scales[this.scale]! * lettersScale();
  }

  private get gripWidth(): number {
    return gripWidth * lettersScale();
  }

  private x(ms: number): number {
    return (ms / 1000) * this.pixelsPerSecond;
  }

  private button(name: IconName, label: string, act: () => void): HTMLButtonElement {
    return h('button', { type: 'button', class: 'quiet square', 'aria-label': label, title: label, on: { click: act } }, icon(name, 16));
  }

  private zoom(step: number): void {
    this.scale = Math.min(scales.length - 1, Math.max(0, this.scale + step));
    this.draw();
  }

  private draw(): void {
    const { model } = this.options;
    this.buttons.clear();
    this.element.hidden = model.document.value === null;
    this.undo.disabled = !model.canUndo;
    this.redo.disabled = !model.canRedo;
    this.nearer.disabled = this.scale === scales.length - 1;
    this.farther.disabled = this.scale === 0;
    const focused = this.element.contains(document.activeElement) && document.activeElement?.classList.contains('cue');
    const { cues } = model;
    if (cues.length > mostCues) {
      replace(this.tracks, h('p', { class: 'empty' }, t('This performance has more than {mostCues} cues, too many to be edited here.', { mostCues })));
      return this.showChosen();
    }
    const rows = new Map<string, { title: string; items: number[] }>();
    cues.forEach((cue, i) => {
      const target = targetOf(cue);
      const key = `${target.kind}${target.number}`;
      if (!rows.has(key)) rows.set(key, { title: trackTitle(target), items: [] });
      rows.get(key)!.items.push(i);
    });
    const width = `${this.x(model.length) + 40}px`;
    this.tracks.style.width = width;
    replace(
      this.tracks,
      this.ruler(),
      [...rows.values()].map(({ title, items }) =>
        h(
          'div',
          { class: 'track', role: 'group', 'aria-label': title },
          h('span', { class: 'track-title', 'aria-hidden': 'true' }, title),
          items.map((i) => this.cue(cues[i]!, i)),
        ),
      ),
      cues.length === 0 ? h('p', { class: 'empty' }, t('No cues yet: add one below.')) : null,
      this.playhead,
    );
    this.showChosen();
    this.tick();
    if (focused) this.buttons.get(Math.max(0, model.chosen.value))?.focus({ preventScroll: true });
  }

  private ruler(): HTMLElement {
    const step = scales[this.scale]! >= 80 ? 1000 : 5000;
    const marks = Array.from({ length: Math.floor(this.options.model.length / step) + 1 }, (_, i) => {
      const mark = h('span', { class: 'mark' }, formatTime(i * step));
      mark.style.left = `${this.x(i * step)}px`;
      return mark;
    });
    const ruler = h('div', { class: 'ruler', 'aria-hidden': 'true' }, marks);
    const seek = (event: PointerEvent): void => {
      const x = event.clientX - ruler.getBoundingClientRect().left;
      this.options.seek(Math.max(0, (x / this.pixelsPerSecond) * 1000));
      this.tick();
    };
    ruler.addEventListener('pointerdown', (event) => {
      ruler.setPointerCapture(event.pointerId);
      seek(event);
    });
    ruler.addEventListener('pointermove', (event) => {
      if (ruler.hasPointerCapture(event.pointerId)) seek(event);
    });
    return ruler;
  }

  private cue(cue: Cue, index: number): HTMLElement {
    const { model } = this.options;
    const button = h(
      'button',
      {
        type: 'button',
        class: `cue cue-${targetOf(cue).kind}`,
        tabindex: -1,
        'aria-label': t('{name}, {from} to {to}', { name: cueName(cue), from: formatTime(cue.time), to: formatTime(endOf(cue)) }),
        title: cueName(cue),
        on: { focus: () => model.choose(index) },
      },
      cueName(cue),
    );
    this.span(button, cue.time, endOf(cue));
    this.buttons.set(index, button);
    this.makeDraggable(button, index, (event) => {
      const { left, right, width } = button.getBoundingClientRect();
      if (event.pointerType === 'touch' || width < 3 * edge) return 'all';
      return event.clientX - left < edge ? 'start' : right - event.clientX < edge ? 'end' : 'all';
    });
    return button;
  }

  private span(button: HTMLElement, start: number, end: number): void {
    button.style.left = `${this.x(start)}px`;
    button.style.width = `${Math.max(6, this.x(end - start) - 1)}px`;
  }

  /** `partAt`: the part of the cue that a pointer takes at `element`. */
  private makeDraggable(element: HTMLElement, index: number, partAt: (event: PointerEvent) => CuePart): void {
    const { model } = this.options;
    const cue = model.cues[index]!;
    const button = (): HTMLButtonElement => this.buttons.get(index)!;
    dragCue(element, {
      cue,
      pixelsPerSecond: () => this.pixelsPerSecond,
      partAt,
      isChosen: () => model.chosen.value === index,
      choose: () => {
        model.choose(index);
        button().focus({ preventScroll: true });
      },
      show: (start, end) => {
        this.span(button(), start, end);
        this.showTimes(start, end);
      },
      place: (start, end) => model.place(start, end),
    });
  }

  /** A finger lengthens the chosen cue at grips beside it, since the edges of a cue are narrower than a finger. */
  private makeGrips(index: number): void {
    for (const grip of this.grips) grip.remove();
    const button = this.buttons.get(index);
    if (!button) return;
    this.grips = (['start', 'end'] as const).map((part) => {
      const grip = h('span', { class: `cue-grip cue-grip-${part}`, 'aria-hidden': 'true' });
      this.makeDraggable(grip, index, () => part);
      return grip;
    });
    button.after(...this.grips);
  }

  private showTimes(start: number, end: number): void {
    this.start.value = (start / 1000).toFixed(2);
    this.end.value = (end / 1000).toFixed(2);
    const [before, after] = this.grips;
    if (!before || !after) return;
    before.hidden = this.x(start) < this.gripWidth; // it would be outside of the track
    before.style.left = `${this.x(start) - this.gripWidth}px`;
    after.style.left = `${this.x(end)}px`;
  }

  private showChosen(): void {
    const { model } = this.options;
    const chosen = model.chosen.value;
    const cue = model.cues[chosen];
    // One cue is a stop of the Tab key; the arrow keys lead to the others.
    for (const [i, button] of this.buttons) {
      button.tabIndex = i === Math.max(0, chosen) ? 0 : -1;
      button.setAttribute('aria-pressed', String(i === chosen));
    }
    for (const control of [this.start, this.end]) control.disabled = !cue;
    setIdle(this.remove, t('Delete the cue'), cue ? null : this.noCue());
    this.makeGrips(chosen);
    if (cue) this.showTimes(cue.time, endOf(cue));
    else this.start.value = this.end.value = '';
  }

  private noCue(): Idle {
    if (this.options.model.cues.length === 0) return { why: t('No cues yet: add one below.') };
    return { why: t('No cue is chosen.'), help: { label: t('Choose the first'), act: () => this.choose(0) } };
  }

  private add(): void {
    const time = Math.round(this.options.position());
    const [member, number] = this.kind.value.split('-');
    const cue: Cue = { time, duration: newCueLength };
    if (member === 'viseme') cue.viseme = Number(number);
    else if (member === 'expression') cue.expression = Number(number);
    else if (member === 'fap') Object.assign(cue, { fap: Number(number), value: Math.round((faps[Number(number) - 1]?.usualMax ?? 0) / 2) });
    else cue.blink = 'both';
    this.options.model.add(cue);
  }

  private key(event: KeyboardEvent): void {
    const { model } = this.options;
    const onCue = (event.target as Element).classList.contains('cue');
    const cue = model.cues[model.chosen.value];
    const control = event.ctrlKey || event.metaKey;
    const shift = (by: number): void => {
      if (!cue) return;
      const end = endOf(cue);
      if (event.shiftKey) model.place(cue.time, end + by);
      else model.place(Math.max(0, cue.time + by), Math.max(end - cue.time, end + by));
    };
    const actions: Record<string, () => void> = control
      ? { z: () => (event.shiftKey ? model.redo() : model.undo()), y: () => model.redo() }
      : onCue
        ? {
            ArrowLeft: () => shift(-20),
            ArrowRight: () => shift(20),
            ArrowUp: () => this.choose(-1),
            ArrowDown: () => this.choose(1),
            Delete: () => model.remove(),
            Backspace: () => model.remove(),
          }
        : {};
    const action = event.altKey ? undefined : actions[control ? event.key.toLowerCase() : event.key];
    if (!action || event.target instanceof HTMLInputElement) return;
    event.preventDefault();
    action();
  }

  private choose(step: number): void {
    this.options.model.chooseNext(step);
    this.buttons.get(this.options.model.chosen.value)?.focus();
  }
}

function kinds(): HTMLElement[] {
  const group = (label: string, options: HTMLElement[]): HTMLElement => h('optgroup', { label }, options);
  return [
    group(t('Visemes'), visemes.slice(1).map((viseme, i) => h('option', { value: `viseme-${i + 1}` }, visemeTitle(viseme)))),
    group(t('Expressions'), expressions.slice(1).map(({ name }, i) => h('option', { value: `expression-${i + 1}` }, nameOf(capital(name))))),
    group(t('Others'), [h('option', { value: 'blink-0' }, t('Blink'))]),
    group(t('Face parameters'), faps.slice(2).map(({ number, name, group: of }) => h('option', { value: `fap-${number}` }, `${number} ${fapTitle(name, of)}`))),
  ];
}

function trackTitle({ kind, number }: CueTarget): string {
  switch (kind) {
    case 'viseme':
      return t('Visemes');
    case 'expression':
      return nameOf(capital(expressions[number]?.name ?? ''));
    case 'fap': {
      const fap = faps[number - 1];
      return fap ? `${number} ${fapTitle(fap.name, fap.group)}` : String(number);
    }
    case 'look_at':
      return t('Looking');
    case 'head':
      return t('Head');
    case 'blink':
      return t('Blink');
  }
}

function cueName(cue: Cue): string {
  if (cue.viseme === undefined) return trackTitle(targetOf(cue));
  const first = Array.isArray(cue.viseme) ? cue.viseme[0] : cue.viseme;
  const number = numberOfViseme(first);
  return number === 0 ? t('Silence') : (visemes[number]?.phonemes.join(' ') ?? String(first));
}
