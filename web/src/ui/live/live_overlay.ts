import type { PlayoutStats } from '@client/index.ts';
import type { LiveStats } from '../../net/live.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import type { LiveModel } from './live_model.ts';
import { h, setText, svg } from '../shared/dom.ts';
import { Signal } from '../shared/signal.ts';
import { t } from '../../words/words.ts';

/** Length of the curve, samples: a minute at two samples a second. */
const curveLength = 120;
const curveWidth = 120;
const curveHeight = 28;

/** The measurements of the followed stream over the picture, with the data rate of the last minute as a curve. */
export class LiveOverlay {
  readonly element: HTMLElement;
  readonly on = new Signal(false);
  private readonly rate = this.figure(t('Data'));
  private readonly frames = this.figure(t('Frames'));
  private readonly buffer = this.figure(t('Buffer'));
  private readonly late = this.figure(t('Late'));
  private readonly dropped = this.figure(t('Dropped'));
  private readonly line = svg('polyline', { fill: 'none', 'vector-effect': 'non-scaling-stroke' });
  private readonly top = h('small', { class: 'muted' });
  /** kbit/s, oldest first. */
  private samples: number[] = [];

  constructor(
    private readonly live: LiveModel,
    driver: FaceDriver,
  ) {
    const rows = [this.rate, this.frames, this.buffer, this.late, this.dropped];
    this.element = h(
      'div',
      { class: 'live-overlay', role: 'group', 'aria-label': t('Figures of the stream') },
      h('dl', {}, ...rows.map(({ row }) => row)),
      h(
        'div',
        { class: 'live-curve', role: 'img', 'aria-label': t('Data rate of the last minute') },
        svg('svg', { viewBox: `0 0 ${curveWidth} ${curveHeight}`, preserveAspectRatio: 'none', 'aria-hidden': 'true' }, this.line),
        this.top,
      ),
    );
    live.following.watch(() => (this.samples = []));
    const show = (): void => {
      this.element.hidden = !this.on.value || live.following.value === null || driver.source.value !== 'stream';
    };
    for (const signal of [this.on, live.following, driver.source] as Signal<unknown>[]) signal.watch(show);
  }

  /** Call twice a second. `playout`: of the displayed face, or null. */
  tick(playout: Readonly<PlayoutStats> | null): void {
    const { stats } = this.live;
    const isOpen = this.live.status.value.kind === 'open';
    const rate = isOpen ? kilobits(stats) : 0;
    if (this.live.following.value !== null) this.samples = [...this.samples.slice(1 - curveLength), rate];
    if (this.element.hidden) return;
    setText(this.rate.value, isOpen ? t('{number} kbit/s', { number: Number(rate.toFixed(1)) }) : '–');
    setText(this.frames.value, isOpen ? t('{number} a second', { number: stats.framesPerSecond.toFixed(0) }) : '–');
    setText(this.buffer.value, milliseconds(playout?.delay));
    setText(this.late.value, lateness(playout));
    setText(this.dropped.value, String(stats.dropped));
    this.drawCurve();
  }

  private drawCurve(): void {
    const highest = Math.max(1, ...this.samples);
    const step = curveWidth / (curveLength - 1);
    const begin = curveLength - this.samples.length;
    const points = this.samples.map(
      (value, i) => `${((begin + i) * step).toFixed(1)},${(curveHeight - 1 - (value / highest) * (curveHeight - 2)).toFixed(1)}`,
    );
    this.line.setAttribute('points', points.join(' '));
    setText(this.top, t('up to {number} kbit/s', { number: Number(highest.toFixed(1)) }));
  }

  private figure(term: string): { row: HTMLElement; value: HTMLElement } {
    const value = h('dd');
    return { row: h('div', {}, h('dt', {}, term), value), value };
  }
}

const kilobits = ({ bytesPerSecond }: LiveStats): number => (bytesPerSecond * 8) / 1000;

const milliseconds = (value: number | undefined): string =>
  value !== undefined && Number.isFinite(value) ? t('{delay} ms', { delay: Math.round(value) }) : '–';

/** How far the picture is behind its time now, and how often frames arrived too late for it. */
function lateness(playout: Readonly<PlayoutStats> | null): string {
  if (!playout || !Number.isFinite(playout.delay)) return '–';
  const now = milliseconds(Math.max(0, -playout.error));
  if (playout.starved === 0) return now;
  return playout.starved === 1 ? t('{now}, once', { now }) : t('{now}, {starved} times', { now, starved: playout.starved });
}
