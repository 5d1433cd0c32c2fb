import { cssColour, type Rgb } from '../../face/influence_palette.ts';
import { h } from '../shared/dom.ts';

/** A small square of a colour of the influence view. */
export function swatch(colour: Rgb, hatched = false): HTMLElement {
  const element = h('i', { class: hatched ? 'swatch hatched' : 'swatch', 'aria-hidden': 'true' });
  element.style.backgroundColor = cssColour(colour); // the page's security policy allows no style attributes
  return element;
}
