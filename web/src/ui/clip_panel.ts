import { parseFap, type FapFileReading } from '@protocol/fap_file.ts';
import { ProtocolError } from '@protocol/protocol_error.ts';
import { Clip, type ClipPlayer } from '../face/clip.ts';
import { excerptBox } from './excerpt_box.ts';
import { excerptAt } from './document_place.ts';
import { h, redraw, replace, setText } from './dom.ts';
import { fapWarningText } from './fap_words.ts';
import { chooseFile } from './file_button.ts';
import { formatCount, formatTime } from './format.ts';
import { icon } from './icons.ts';
import { capital } from './names.ts';

/** Plays a .fap file on the face on screen; no server takes part. */
export class ClipPanel {
  readonly element: HTMLElement;
  private readonly body = h('div', { class: 'clip-body' });
  private readonly clock = h('span', { class: 'number' });
  private readonly seek = h('input', { type: 'range', class: 'progress', min: 0, step: 1, 'aria-label': 'Position' });
  private file: { name: string; reading: FapFileReading } | null = null;
  private absent: 'zero' | 'keep' = 'zero';
  private held = false;
  private shownPlaying = false;

  constructor(
    private readonly player: ClipPlayer,
    /** The face is to show the clip now. */
    private readonly takeFace: () => void,
  ) {
    this.seek.addEventListener('input', () => {
      this.held = true;
      takeFace();
      player.seek(Number(this.seek.value));
      this.showClock();
    });
    this.seek.addEventListener('change', () => (this.held = false));
    this.element = h(
      'section',
      { class: 'clip' },
      h('header', { class: 'section-head' }, h('h2', {}, 'Play a file'), h('span', { class: 'muted small' }, '.fap')),
      chooseFile({
        label: 'Choose a .fap file',
        note: 'or drop it',
        accept: '.fap',
        take: (file) => void this.takeFile(file),
      }),
      this.body,
    );
  }

  async takeFile(file: File): Promise<void> {
    const text = await file.text();
    try {
      this.file = { name: file.name, reading: parseFap(text) };
      this.read(false);
      this.play();
    } catch (error) {
      if (!(error instanceof ProtocolError)) throw error;
      this.file = null;
      this.player.load(null);
      this.refuse(file.name, error, text);
    }
    this.element.scrollIntoView({ block: 'nearest' });
  }

  /** Called a few times a second. */
  tick(): void {
    if (!this.file) return;
    if (this.player.playing !== this.shownPlaying) this.draw();
    this.showClock();
  }

  private play(): void {
    this.takeFace();
    this.player.play();
    this.draw();
  }

  private read(keepPlace: boolean): void {
    if (this.file) this.player.load(Clip.ofFap(this.file.reading.file, { absent: this.absent }), keepPlace);
  }

  private showClock(): void {
    const { position, clip } = this.player;
    const duration = clip?.duration ?? 0;
    setText(this.clock, `${formatTime(position)} / ${formatTime(duration)}`);
    this.seek.max = String(Math.max(1, Math.ceil(duration)));
    if (!this.held) this.seek.value = String(Math.round(position));
    this.seek.style.setProperty('--to', `${duration > 0 ? (position / duration) * 100 : 0}%`);
  }

  private draw(): void {
    redraw(this.body, () => this.drawBody());
  }

  private drawBody(): void {
    const { player, file } = this;
    if (!file) return replace(this.body);
    this.shownPlaying = player.playing;
    const { warnings } = file.reading;
    const { rate, frames } = file.reading.file;
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
          player.playing ? 'Pause' : 'Play',
        ),
        h('label', { class: 'check' }, loop, 'Loop'),
        h('span', { class: 'grow' }),
        h('span', { class: 'muted small' }, `${formatCount(frames.length)} frames, ${rate} a second`),
      ),
      h(
        'div',
        { class: 'row' },
        h('span', { class: 'muted grow', title: 'What a FAP is in a frame that leaves it out' }, 'Left out'),
        h('div', { class: 'segments', role: 'group', 'aria-label': 'FAPs that a frame leaves out' }, [
          this.absentButton('zero', 'Are zero'),
          this.absentButton('keep', 'Stay'),
        ]),
      ),
      warnings.length > 0
        ? h(
            'details',
            { class: 'notice clip-warnings' },
            h('summary', {}, `${warnings.length} ${warnings.length === 1 ? 'peculiarity' : 'peculiarities'} of the file`),
            h(
              'ul',
              {},
              warnings.map((warning) => h('li', {}, `${fapWarningText(warning)}.`)),
            ),
          )
        : null,
    );
    this.showClock();
  }

  private absentButton(value: 'zero' | 'keep', title: string): HTMLElement {
    return h(
      'button',
      {
        type: 'button',
        'data-focus': value,
        'aria-pressed': String(this.absent === value),
        on: {
          click: () => {
            this.absent = value;
            this.read(true);
            this.draw();
          },
        },
      },
      title,
    );
  }

  private toggle(): void {
    if (!this.player.playing) return this.play();
    this.player.pause();
    this.draw();
  }

  private refuse(name: string, error: ProtocolError, text: string): void {
    replace(
      this.body,
      h(
        'div',
        { class: 'notice error', role: 'alert' },
        icon('warning', 16),
        h(
          'div',
          { class: 'grow' },
          h('strong', {}, `${name}: ${error.message}`),
          error.where ? h('p', {}, capital(error.where)) : null,
          excerptBox(excerptAt(text, error.where)),
        ),
      ),
    );
  }
}
