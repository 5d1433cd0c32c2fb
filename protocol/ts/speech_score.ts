/** ms: durations in a score are multiples of it. */
const scoreUnit = 30;

/** Whether these bytes are a score (SPEC.md, section 2.2) of that text: one with as many words. */
export function isScoreOf(score: Uint8Array, text: string): boolean {
  let words = 0;
  for (let i = 0; i < score.length; i += 1) {
    const high = score[i]! >> 4;
    const low = score[i]! & 15;
    if (high < 15) words += low >> 3;
    else if (low > 6) return false;
    else if (low > 0) {
      i += 1;
      if (!(score[i]! < 64)) return false;
    }
  }
  return words === wordsOf(text).length;
}

/** A word of a text: what is between spaces, tabs and ends of lines. Places in UTF-16 units, as the texts of browsers count. */
export interface Word {
  begin: number;
  end: number;
}

export function wordsOf(text: string): Word[] {
  return Array.from(text.matchAll(/[^ \t\r\n]+/g), ({ 0: word, index }) => ({ begin: index, end: index + word.length }));
}

/** When the words of a score begin, ms after the first. */
export function wordTimes(score: Uint8Array): number[] {
  const times: number[] = [];
  let time = 0;
  for (let i = 0; i < score.length; i += 1) {
    const low = score[i]! & 15;
    if (score[i]! >> 4 === 15) {
      if (low > 0) i += 1;
      continue;
    }
    if (low >= 8) times.push(time);
    time += ((low & 7) + 1) * scoreUnit;
  }
  return times;
}
