import { svg } from '../shared/dom.ts';

/** The parameters of a drawn expression: brow heights (inner, outer), eye opening, mouth corner and opening. */
interface Feeling {
  inner: number;
  outer: number;
  eye: number;
  corner: number;
  open: number;
}

const feelings: Feeling[] = [
  { inner: 0, outer: 0, eye: 1.6, corner: 0, open: 0 },
  { inner: 0, outer: 0.4, eye: 1.3, corner: -3, open: 3.5 },
  { inner: 2.2, outer: -0.8, eye: 1.2, corner: 2.6, open: 0 },
  { inner: -2.4, outer: 1, eye: 1.9, corner: 1.2, open: 1.6 },
  { inner: 2.4, outer: 0.8, eye: 2.3, corner: 1.2, open: 2.2 },
  { inner: -1, outer: -0.2, eye: 1.1, corner: 1.8, open: -1.4 },
  { inner: 2, outer: 2, eye: 2.4, corner: 0.2, open: 5 },
];

/** A small line drawing of expression 1..6 (0: neutral). */
export function expressionFace(expression: number, size = 34): SVGElement {
  const { inner, outer, eye, corner, open } = feelings[expression] ?? feelings[0]!;
  const brow = (side: 1 | -1): string =>
    `M${16 + side * 3} ${11 - inner}Q${16 + side * 6} ${9.6 - (inner + outer) / 2} ${16 + side * 8.5} ${11.2 - outer}`;
  const mouthY = 22 + (expression === 6 ? 0.5 : 0);
  const narrow = expression === 6 ? 3.2 : 5.5;
  const mouth =
    open > 0
      ? `M${16 - narrow} ${mouthY + corner}Q16 ${mouthY - corner * 0.2 - (expression === 6 ? 4 : 0)} ${16 + narrow} ${mouthY + corner}Q16 ${mouthY - corner + open * 1.5} ${16 - narrow} ${mouthY + corner}Z`
      : `M${16 - narrow} ${mouthY + corner}Q16 ${mouthY - corner + open} ${16 + narrow} ${mouthY + corner * (expression === 5 ? 0.2 : 1)}`;
  return svg(
    'svg',
    { viewBox: '0 0 32 32', width: size, height: size, 'aria-hidden': 'true', class: 'feeling' },
    svg('circle', { cx: 16, cy: 16, r: 14.5, class: 'feeling-skin' }),
    svg('path', { d: `${brow(-1)}${brow(1)}`, class: 'feeling-line' }),
    svg('ellipse', { cx: 10.6, cy: 15, rx: 1.5, ry: eye, class: 'feeling-ink' }),
    svg('ellipse', { cx: 21.4, cy: 15, rx: 1.5, ry: eye, class: 'feeling-ink' }),
    svg('path', { d: mouth, class: open > 0 ? 'feeling-mouth' : 'feeling-line' }),
  );
}
