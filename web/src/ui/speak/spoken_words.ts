import type { Timeline } from '../../net/types.ts';

/** A word with the time in which it is heard, ms. */
export interface Word {
  text: string;
  time: number;
  end: number;
}

/** A text as its words, and what stands between them. Places in a timeline are in code points. */
export function wordsOf(text: string, timeline: Timeline): (string | Word)[] {
  const characters = [...text];
  const pieces: (string | Word)[] = [];
  let at = 0;
  for (const { first, count, time, end } of timeline.words) {
    if (first < at || count === 0 || first + count > characters.length) continue; // said again, or nothing to light up
    if (first > at) pieces.push(characters.slice(at, first).join(''));
    at = first + count;
    pieces.push({ text: characters.slice(first, at).join(''), time, end });
  }
  if (at < characters.length) pieces.push(characters.slice(at).join(''));
  return pieces;
}
