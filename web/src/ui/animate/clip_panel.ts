import type { Library } from '@client/motion/index.ts';
import { ProtocolError } from '@protocol/protocol_error.ts';
import type { ClipPlayer } from '../../face/clip.ts';
import { emptyDocument, type CueDocument } from '../../face/cue_sheet.ts';
import { clipOf, kindOfClip, readClipFile, type ClipFile } from '../../face/clip_file.ts';
import { absentChoice, type Absent } from '../documents/absent_choice.ts';
import { bestExample } from '../documents/examples.ts';
import { excerptAt } from '../documents/document_place.ts';
import { h, redraw, replace, setText } from '../shared/dom.ts';
import { exampleSelect } from '../documents/example_select.ts';
import { excerptBox } from '../documents/excerpt_box.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import { fapWarnings } from '../documents/fap_warnings.ts';
import { chooseFile } from '../shared/file_button.ts';
import { formatCount, formatTime } from '../shared/format.ts';
import { messageOf } from '../shared/message_of.ts';
import { icon } from '../shared/icons.ts';
import { capital } from '../shared/names.ts';
import { Signal } from '../shared/signal.ts';
import type { Toasts } from '../shared/toast.ts';
import { Timeline } from './timeline.ts';
import { TimelineModel } from './timeline_model.ts';
import { serverWords, t } from '../../words/words.ts';

/** Plays a performance document or .fap file on this page only, without the server. */
export class ClipPanel {
  readonly element: HTMLElement;
  /** The playback state as text; null while another source drives the face. */
  readonly shown = new Signal<string | null>(null);
  /** Whether the best of the examples moves the face now. */
  readonly examplePlays = new Signal(false);
  private readonly body = h('div', { class: 'clip-body' });
  private readonly clock = h('span', { class: 'number' });
  private readonly seek = h('input', { type: 'range', class: 'progress', min: 0, step: 1, 'aria-label': t('Position') });
  private file: { name: string; content: ClipFile; library: Library } | null = null;
  private newest = 0;
  private absent: Absent = 'zero';
  private held = false;
  private shownPlaying = false;
  private readonly cues = new TimelineModel((document) => this.edited(document));
  private readonly timeline: Timeline;
  private readonly player: ClipPlayer;

  /** `load` gives the library that reads and plays files. */
  constructor(
    private readonly driver: FaceDriver,
    private readonly load: () => Promise<Library>,
    private readonly save: (content: Blob, name: string) => void,
    toasts: Pick<Toasts, 'say'>,
  ) {
    const player = (this.player = driver.clip);
    const seek = (position: number): void => {
      driver.byClip();
      player.seek(position);
      this.showClock();
    };
    this.timeline = new Timeline({ model: this.cues, position: () => player.position, seek, save: () => this.saveDocument(), toasts });
    this.seek.addEventListener('input', () => {
      this.held = true;
      seek(Number(this.seek.value));
    });
    this.seek.addEventListener('change', () => (this.held = false));
    this.element = h(
      'section',
      { class: 'clip' },
      h('header', { class: 'section-head' }, h('h2', {}, t('Play a file')), h('span', { class: 'muted small' }, t('on this page only'))),
      h(
        'div',
        { class: 'script-source' },
        chooseFile({
          label: t('Choose a .json or .fap file'),
          note: t('or drop it'),
          accept: '.json,.fap,application/json',
          take: ([file]) => void this.takeFile(file),
        }),
        exampleSelect((name, text) => void this.take(name, text)),
        h('button', { type: 'button', on: { click: () => void this.begin() } }, icon('plus', 15), t('New performance')),
      ),
      this.body,
      this.timeline.element,
    );
    driver.source.watch((source) => {
      // Redraw only when the clip loses the face: a redraw on gaining it would interrupt a drag of the slider.
      if (source !== 'clip' && this.shown.value !== null) this.draw();
      else this.tell();
    });
  }

  async takeFile(file: File): Promise<void> {
    await this.take(file.name, await file.text());
    this.element.scrollIntoView({ block: 'nearest' });
  }

  /** Plays the best of the examples from its start, or pauses it and plays it on. */
  async toggleExample(): Promise<void> {
    if (this.file?.name === bestExample.name && this.driver.source.value === 'clip') return this.toggle();
    await this.take(bestExample.name, await bestExample.text());
  }

  /** Call a few times a second. */
  tick(): void {
    this.tell();
    if (!this.file) return;
    if (this.player.playing !== this.shownPlaying) this.draw();
    this.showClock();
    this.timeline.tick();
  }

  /** A performance without cues, to be made here. */
  private async begin(): Promise<void> {
    await this.take('performance.json', JSON.stringify(emptyDocument(t('New performance'))), false);
  }

  /** Plays the changed document on from the same place. */
  private edited(document: CueDocument): void {
    const { file } = this;
    if (!file) return;
    this.file = { ...file, content: readClipFile(file.library, 'performance', JSON.stringify(document)) };
    this.driver.byClip();
    this.read(true);
    this.draw();
  }

  private saveDocument(): void {
    const document = this.cues.document.value;
    if (document && this.file)
      this.save(new Blob([JSON.stringify(document, null, 1)], { type: 'application/json' }), `${this.file.name.replace(/\.[a-z0-9]+$/i, '')}.json`);
  }

  private async take(name: string, text: string, plays = true): Promise<void> {
    const number = (this.newest += 1);
    try {
      const library = await this.load();
      if (number !== this.newest) return; // another file was taken meanwhile
      this.file = { name, content: readClipFile(library, kindOfClip(name, text), text), library };
      this.cues.open(this.file.content.kind === 'performance' ? (JSON.parse(text) as CueDocument) : null);
      this.read(false);
      if (plays) return this.play();
      this.driver.byClip();
      this.draw();
    } catch (error) {
      if (number !== this.newest) return;
      this.file = null;
      this.cues.open(null);
      this.player.load(null);
      this.driver.release('clip');
      this.refuse(name, error, text);
    }
  }

  private play(): void {
    this.driver.byClip();
    this.player.play();
    this.draw();
  }

  private read(keepPlace: boolean): void {
    if (this.file) this.player.load(clipOf(this.file.library, this.file.content, this.absent), keepPlace);
  }

  private showClock(): void {
    const { position, clip } = this.player;
    const duration = clip?.duration ?? 0;
    const endless = duration === Infinity;
    setText(this.clock, `${formatTime(position)} / ${endless ? '∞' : formatTime(duration)}`);
    this.seek.hidden = endless;
    if (endless) return;
    this.seek.max = String(Math.max(1, Math.ceil(duration)));
    if (!this.held) this.seek.value = String(Math.round(position));
    this.seek.style.setProperty('--to', `${duration > 0 ? (position / duration) * 100 : 0}%`);
  }

  private tell(): void {
    const { file, player, driver } = this;
    const words = player.playing ? t('Playing {name}', { name: file?.name ?? '' }) : t('{name}, paused', { name: file?.name ?? '' });
    const drives = file !== null && driver.source.value === 'clip';
    this.shown.set(drives ? words : null);
    this.examplePlays.set(drives && player.playing && file.name === bestExample.name);
  }

  private draw(): void {
    this.tell();
    redraw(this.body, () => this.drawBody());
  }

  private drawBody(): void {
    const { player, file } = this;
    if (!file) return replace(this.body);
    this.shownPlaying = player.playing;
    const loop = h('input', { type: 'checkbox', 'data-focus': 'loop', checked: player.loop });
    loop.addEventListener('change', () => (player.loop = loop.checked));
    replace(
      this.body,
      h('div', { class: 'row' }, icon('film', 16), h('strong', { class: 'grow' }, file.name), this.clock),
      this.seek,
      h(
        'div',
        { class: 'row' },
        h(
          'button',
          {
            type: 'button',
            class: player.playing ? '' : 'primary',
            'data-focus': 'play',
            on: { click: () => this.toggle() },
          },
          icon(player.playing ? 'pause' : 'play', 15),
          player.playing ? t('Pause') : t('Play'),
        ),
        player.clip?.duration === Infinity ? null : h('label', { class: 'check' }, loop, t('Loop')),
        h('span', { class: 'grow' }),
        h('span', { class: 'muted small' }, sizeOf(file.content)),
      ),
      ...this.drawFap(file.content),
    );
    this.showClock();
  }

  private drawFap(content: ClipFile): (HTMLElement | null)[] {
    if (content.kind !== 'fap') return [];
    return [
      absentChoice(this.absent, (absent) => {
        this.absent = absent;
        this.read(true);
        this.draw();
      }),
      fapWarnings(content.take.warnings.map(({ message }) => `${capital(serverWords(message))}.`)),
    ];
  }

  private toggle(): void {
    if (!this.player.playing) return this.play();
    this.player.pause();
    this.draw();
  }

  private refuse(name: string, error: unknown, text: string): void {
    const where = error instanceof ProtocolError ? error.where : '';
    replace(
      this.body,
      h(
        'div',
        { class: 'notice error', role: 'alert' },
        icon('warning', 16),
        h(
          'div',
          { class: 'grow' },
          h('strong', {}, `${name}: ${messageOf(error)}`),
          placeOf(where),
          excerptBox(excerptAt(text, where)),
        ),
      ),
    );
  }
}

function sizeOf(content: ClipFile): string {
  if (content.kind === 'fap') {
    const { frameRate, frames } = content.take;
    return t('{count} frames, {frameRate} a second', { count: formatCount(frames.length), frameRate });
  }
  const { cues, hasIdle } = content;
  const count = cues === 1 ? t('1 cue') : t('{count} cues', { count: formatCount(cues) });
  if (!hasIdle) return count;
  return cues > 0 ? t('{count}, idle life', { count }) : t('Idle life');
}

/** The place of an error: a JSON pointer as code, "line 3, word 2" as text. */
function placeOf(where: string): HTMLElement | null {
  if (where === '') return null;
  return where.startsWith('/') ? h('p', {}, t('At '), h('code', {}, where)) : h('p', {}, capital(serverWords(where)));
}
