import { visemes } from '@protocol/generated/mpeg4.ts';
import { placeOf, visemePlaces, visemesAt, type Place } from '../../face/viseme_plane.ts';
import { h, setText } from '../shared/dom.ts';
import { formatPercent } from '../shared/format.ts';
import { t } from '../../words/words.ts';

/** How far an arrow key goes, of the pad. */
const keyStep = 0.05;

const soundsOf = (viseme: number): string => (viseme === 0 ? t('rest') : visemes[viseme]!.phonemes.join(' '));

/** A plane of mouth shapes: each place is a blend of the two visemes nearest to it. */
export class VisemePad {
  readonly element: HTMLElement;
  private readonly handle = h('span', { class: 'viseme-handle' });
  private readonly said = h('output', { class: 'visually-hidden', 'aria-live': 'polite' });
  private readonly pad: HTMLElement;
  private place: Place = visemePlaces[0]!;

  /** `onBlend`: the first viseme with its share, 0 to 1, and the second one with the rest. */
  constructor(private readonly onBlend: (first: number, second: number, share: number) => void) {
    this.pad = h(
      'div',
      { class: 'viseme-pad', role: 'application', tabindex: 0, 'aria-label': t('Plane of mouth shapes. Arrow keys move over it: to the right wider, down more open.') },
      visemePlaces.map((place, viseme) => put(h('span', { class: 'viseme-place', 'aria-hidden': 'true' }, soundsOf(viseme)), place)),
      this.handle,
    );
    this.element = h('div', {}, this.pad, this.said);
    const follow = (event: PointerEvent): void => {
      const box = this.pad.getBoundingClientRect();
      this.go([(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height]);
    };
    this.pad.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      this.pad.setPointerCapture(event.pointerId);
      follow(event);
    });
    this.pad.addEventListener('pointermove', (event) => {
      if (this.pad.hasPointerCapture(event.pointerId)) follow(event);
    });
    this.pad.addEventListener('keydown', (event) => this.key(event));
    this.draw();
  }

  /** Shows the blend that other controls have set. */
  show(first: number, second: number, share: number): void {
    const now = visemesAt(this.place);
    if (now.first === first && now.second === second && Math.abs(now.share - share) < 0.02) return;
    this.place = placeOf(first, second, share);
    this.draw();
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!step || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    this.go([this.place[0] + step[0]! * keyStep, this.place[1] + step[1]! * keyStep]);
  }

  private go([x, y]: Place): void {
    this.place = [Math.min(1, Math.max(0, x)), Math.min(1, Math.max(0, y))];
    const { first, second, share } = visemesAt(this.place);
    this.draw();
    setText(this.said, `${soundsOf(first)} ${formatPercent(share)}, ${soundsOf(second)} ${formatPercent(1 - share)}`);
    this.onBlend(first, second, share);
  }

  private draw(): void {
    put(this.handle, this.place);
  }
}

function put(element: HTMLElement, [x, y]: Place): HTMLElement {
  element.style.left = `${x * 100}%`;
  element.style.top = `${y * 100}%`;
  return element;
}
