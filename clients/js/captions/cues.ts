import { wordsOf, wordTimes } from '../../../protocol/ts/speech_score.ts';
import type { SpokenText } from '../stream_types.ts';

/** What is shown at once. Times in ms of the stream's clock. */
export interface Cue {
  begin: number;
  end: number;
  text: string;
  /** BCP 47; empty: unknown. */
  language: string;
}

/** Two lines of 37 letters, as subtitles have; a letter of Chinese, Japanese or Korean is as wide as two. */
const most = 74;
/** ms that the last words of a text stay, and any words at least, unless others follow. */
const tail = 600;
const least = 1200;
/** Letters of a text without spaces that are not divided. */
const longestPiece = 24;

/** A part of a text that is not divided, with what it is said at, ms after the first word. */
interface Piece {
  begin: number;
  end: number;
  time: number;
}

/**
 * The cues of a text: all of it, in as few parts of about the same length as fit. WebVTT divides alike
 * (core/speech/cues.h); both are tested by tests/golden/speech/cues.json.
 */
export function cuesOf({ text, score, mediaTime, duration, language }: SpokenText): Cue[] {
  const pieces = piecesOf(text, score, duration);
  const first = pieces[0];
  if (!first) return [];
  const wide = (from: number, to: number): number => width(text.slice(from, to));
  const cues: Cue[] = [];
  const last = pieces.at(-1)!.end;
  const parts = partsOf(pieces, wide);
  const target = wide(first.begin, last) / parts;
  let begin = first;
  const close = (end: number): void => {
    const time = mediaTime + begin.time;
    cues.push({ begin: time, end: Infinity, text: text.slice(begin.begin, end).trim(), language });
  };
  pieces.forEach((piece, i) => {
    const before = pieces[i - 1];
    if (!before || before.begin < begin.begin || wide(begin.begin, last) <= most) return;
    const has = wide(begin.begin, before.end);
    // The end of a clause is a good place to divide, if the rest then needs no more parts.
    const isClause = has >= target * 0.6 && /[,;:،؛、，；。！？｡]["')\]}”’»」』）]*$/.test(text.slice(before.begin, before.end)) && partsOf(pieces.slice(i), wide) < parts - cues.length;
    if (has < target && !isClause && wide(begin.begin, piece.end) <= most) return;
    close(before.end);
    begin = piece;
  });
  close(text.length);
  cues.forEach((cue, i) => {
    cue.end = cues[i + 1]?.begin ?? Math.max(mediaTime + duration + tail, cue.begin + least);
  });
  return cues;
}

/** As few cues as hold all pieces. */
function partsOf(pieces: readonly Piece[], wide: (from: number, to: number) => number): number {
  let parts = 1;
  let begin = pieces[0]!.begin;
  for (const piece of pieces) {
    if (wide(begin, piece.end) <= most) continue;
    parts += 1;
    begin = piece.begin;
  }
  return parts;
}

/** The words; those that are longer than a cue, of languages that write no spaces, in pieces with times by their length. */
function piecesOf(text: string, score: Uint8Array, duration: number): Piece[] {
  const times = wordTimes(score);
  return wordsOf(text).flatMap(({ begin, end }, i) => {
    const time = times[i] ?? duration;
    if (width(text.slice(begin, end)) <= most) return [{ begin, end, time }];
    const perUnit = ((times[i + 1] ?? duration) - time) / (end - begin);
    return dividedAt(text.slice(begin, end)).map((place, k, places) => ({
      begin: begin + place,
      end: begin + (places[k + 1] ?? end - begin),
      time: time + perUnit * place,
    }));
  });
}

/** Where the words of a text without spaces begin, as far as the browser knows; a word that is too long is divided anywhere. */
function dividedAt(text: string): number[] {
  const places = [0];
  if (typeof Intl.Segmenter === 'function') {
    for (const { index, segment, isWordLike } of new Intl.Segmenter(undefined, { granularity: 'word' }).segment(text)) {
      if (index > 0 && (isWordLike === true || /\p{Extended_Pictographic}/u.test(segment))) places.push(index);
    }
  }
  return places.flatMap((place, i) => {
    const length = (places[i + 1] ?? text.length) - place;
    return Array.from({ length: Math.ceil(length / longestPiece) }, (_, k) => place + k * longestPiece);
  });
}

function width(text: string): number {
  let sum = 0;
  for (const letter of text) sum += /[\u1100-\u115f\u2e80-\ua4cf\uac00-\ud7a3\uf900-\ufaff\ufe30-\ufe4f\uff00-\uff60]/.test(letter) ? 2 : 1;
  return sum;
}
