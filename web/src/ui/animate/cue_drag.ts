import { endOf, shortestCue, type Cue } from '../../face/cue_sheet.ts';

export type CuePart = 'start' | 'end' | 'all';

export interface CueDragOptions {
  cue: Cue;
  pixelsPerSecond: () => number;
  /** The part of the cue that a pointer takes. */
  partAt: (event: PointerEvent) => CuePart;
  isChosen: () => boolean;
  choose: () => void;
  /** While the cue is dragged: its start and end, ms. */
  show: (start: number, end: number) => void;
  /** At the end of a drag that moved it. */
  place: (start: number, end: number) => void;
}

/** A finger that rests so long takes a cue that is not chosen, ms; before, it scrolls. */
const longPress = 400;
/** How far a resting finger may roll, pixels. */
const roll = 8;

/**
 * Lets a cue be moved or lengthened at `element`: by mouse at once; by finger at once if the cue is chosen, else after a long
 * press, so that a finger scrolls the tracks from anywhere.
 */
export function dragCue(element: HTMLElement, options: CueDragOptions): void {
  const { cue } = options;
  let drag: { x: number; part: CuePart } | null = null;
  let press: { x: number; y: number; timer: number } | null = null;
  const at = (event: PointerEvent): [number, number] => {
    const by = drag ? ((event.clientX - drag.x) / options.pixelsPerSecond()) * 1000 : 0;
    const [from, to] = [cue.time, endOf(cue)];
    if (drag?.part === 'start') return [Math.min(Math.max(0, from + by), to - shortestCue), to];
    if (drag?.part === 'end') return [from, Math.max(from + shortestCue, to + by)];
    const start = Math.max(0, from + by);
    return [start, start + to - from];
  };
  const take = (event: PointerEvent): void => {
    options.choose();
    element.setPointerCapture(event.pointerId);
    element.classList.add('held');
    drag = { x: event.clientX, part: options.partAt(event) };
  };
  const leave = (): void => {
    if (press) clearTimeout(press.timer);
    press = drag = null;
    element.classList.remove('held');
  };
  element.addEventListener('pointerdown', (event) => {
    if (event.button !== 0) return;
    leave();
    if (event.pointerType !== 'touch' || options.isChosen()) return take(event);
    // A page that was busy gets the moves that are due before its next frame; they end the press.
    const timer = window.setTimeout(() => requestAnimationFrame(() => press?.timer === timer && take(event)), longPress);
    press = { x: event.clientX, y: event.clientY, timer };
  });
  element.addEventListener('pointermove', (event) => {
    if (drag) options.show(...at(event));
    else if (press && Math.hypot(event.clientX - press.x, event.clientY - press.y) > roll) leave();
  });
  element.addEventListener('pointercancel', () => {
    leave();
    options.show(cue.time, endOf(cue));
  });
  element.addEventListener('pointerup', (event) => {
    const moved = drag !== null && Math.abs(event.clientX - drag.x) > 2;
    const place = at(event);
    leave();
    if (moved) options.place(...place);
  });
  // What a finger may do is settled when it comes down; a long press takes the scrolling back.
  element.addEventListener('touchmove', (event) => drag && event.preventDefault(), { passive: false });
  element.addEventListener('contextmenu', (event) => (drag || press) && event.preventDefault());
}
