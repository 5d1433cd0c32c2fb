import { firstLowLevelFap, lastLowLevelFap, maxBlend, maxExpression, maxViseme } from './face_frame.ts';
import { ProtocolError } from './protocol_error.ts';

// .fap files: rules in protocol/FAP_FILE.md. The same as protocol/cpp/fap_file.h; protocol/vectors/fap tests both.

/** FAP 1 in a file. Selects 0..14, blend 0..63; viseme_def (0 or 1) is preserved but has no effect. */
export interface FapFileViseme {
  select1: number;
  select2: number;
  blend: number;
  viseme_def: number;
}

/** FAP 2 in a file. Selects 0..6, intensities 0..63; the last two (0 or 1) are preserved but have no effect. */
export interface FapFileExpression {
  select1: number;
  intensity1: number;
  select2: number;
  intensity2: number;
  init_face: number;
  expression_def: number;
}

export interface FapFileFrame {
  /** Increasing from 0, possibly with gaps. */
  number: number;
  /** The FAPs present in the frame: numbers 1..68, increasing. */
  present: number[];
  /** Defined if FAP 1 is present. */
  viseme?: FapFileViseme;
  /** Defined if FAP 2 is present. */
  expression?: FapFileExpression;
  /** Values by FAP number (entries 0..2 unused), FAP units; 0 if absent. */
  values: Float64Array;
}

export interface FapFile {
  /** Frames per second, 0.001..1000. */
  rate: number;
  /** Printable ASCII without blanks; has no meaning. */
  name: string;
  /** At least one frame, by increasing number; the first is 0. */
  frames: FapFileFrame[];
}

/** Deviations from the usual form that the reader accepts; FAP_FILE.md defines how each is read. */
export const fapFileOddities = [
  'other_version',
  'blank_in_name',
  'count_differs',
  'extra_flag',
  'few_values',
  'more_values',
  'not_finite',
  'first_number_not_zero',
  'numbers_not_rising',
  'numbers_left_out',
  'single_number_viseme',
  'packed_viseme',
  'single_number_expression',
  'unknown_select',
  'strength_out_of_range',
  'strength_not_whole',
] as const;
export type FapFileOddity = (typeof fapFileOddities)[number];

export interface FapFileWarning {
  oddity: FapFileOddity;
  /** The first line with this oddity, from 1. */
  line: number;
  /** Number of such lines or values. */
  count: number;
}

export interface FapFileReading {
  file: FapFile;
  /** At most one warning per oddity, in the order of `fapFileOddities`. */
  warnings: FapFileWarning[];
}

export const fapFileLimits = { bytes: 64 * 1024 * 1024, lineBytes: 8192, frames: 100_000, numbers: 1_000_000 };

const fapCount = lastLowLevelFap;
const visemeFields = 4;
const expressionFields = 6;
const maxNameLength = 256;
/** The packed form of FAP 1: (select1 * 10000 + 100000) + (select2 * 100 + 1000) + (blend + 10). */
const packedBase = 101_010;
const maxValue = 1e9;
/** Smaller values are read as 0: they are far below visible motion, and so no number needs an exponent. */
const leastValue = 1e-6;
const maxWord = 64;

interface Line {
  number: number;
  words: string[];
}

const fail = (code: ProtocolError['code'], line: number, message: string): never => {
  throw new ProtocolError(code, `line ${line}`, message);
};
const failAt = (code: ProtocolError['code'], line: Line, word: number, message: string): never => {
  throw new ProtocolError(code, `line ${line.number}, word ${word + 1}`, message);
};
const quoted = (word: string): string => {
  const text = word.slice(0, 24).replace(/[^\x21-\x7e]/g, '?');
  return word.length > 24 ? `"${text}..."` : `"${text}"`;
};

/** Parses a whole word as a number, including all spellings of NaN and infinity; else null. */
export function readFapNumber(word: string): number | null {
  if (word.length > maxWord) return null;
  const negative = word.startsWith('-');
  const digits = negative || word.startsWith('+') ? word.slice(1) : word;
  if (/^(inf|infinity|1\.#inf)$/i.test(digits)) return negative ? -Infinity : Infinity;
  if (/^(nan|1\.#qnan|1\.#ind)$/i.test(digits)) return NaN;
  if (!/^(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(digits)) return null;
  // A number too large for a double stays finite and is refused as out of range.
  const value = Math.min(Number(digits), Number.MAX_VALUE);
  if (value < leastValue) return 0;
  return negative ? -value : value;
}

class Reader {
  private readonly lines: IterableIterator<Line>;
  private readonly frames: { frame: FapFileFrame; line: number }[] = [];
  private readonly noted = new Map<FapFileOddity, FapFileWarning>();
  private lastLine = 0;
  private headerLine = 0;

  constructor(text: string) {
    this.lines = this.split(text);
  }

  read(): FapFileReading {
    const { rate, name, count } = this.readHeader();
    for (let mask = this.next(); mask; mask = this.next()) {
      if (this.frames.length >= fapFileLimits.frames) {
        fail('too_large', mask.number, `a file has at most ${fapFileLimits.frames} frames`);
      }
      const flags = this.readMask(mask);
      const values = this.next() ?? fail('truncated', mask.number, 'the file ends after this mask, without its values');
      this.frames.push({ frame: this.readValues(values, flags), line: values.number });
    }
    if (this.frames.length === 0) fail('malformed', this.lastLine, 'the file ends without a frame');
    const frames = this.ordered();
    if (count !== this.frames.length) this.note('count_differs', this.headerLine);
    const order = (warning: FapFileWarning): number => fapFileOddities.indexOf(warning.oddity);
    return {
      file: { rate, name, frames },
      warnings: [...this.noted.values()].sort((a, b) => order(a) - order(b)),
    };
  }

  private next(): Line | null {
    const { value, done } = this.lines.next();
    return done ? null : (value as Line);
  }

  private *split(text: string): IterableIterator<Line> {
    const ends = /\r\n|\r|\n/g;
    for (let at = text.startsWith('\uFEFF') ? 1 : 0; at < text.length;) {
      ends.lastIndex = at;
      const end = ends.exec(text);
      const line = text.slice(at, end ? end.index : text.length);
      at = end ? end.index + end[0].length : text.length;
      this.lastLine += 1;
      if (line.length > fapFileLimits.lineBytes) {
        fail('too_large', this.lastLine, `has more than ${fapFileLimits.lineBytes} bytes`);
      }
      if (line.startsWith('#')) continue;
      const words = line.split(/[ \t\v\f]+/).filter((word) => word !== '');
      if (words.length > 0) yield { number: this.lastLine, words };
    }
  }

  private note(oddity: FapFileOddity, line: number): void {
    const before = this.noted.get(oddity);
    if (before) before.count += 1;
    else this.noted.set(oddity, { oddity, line, count: 1 });
  }

  private number(line: Line, word: number): number {
    const text = line.words[word]!;
    return readFapNumber(text) ?? failAt('malformed', line, word, `${quoted(text)} is no number`);
  }

  private readHeader(): { rate: number; name: string; count: number } {
    const line = this.next() ?? fail('malformed', Math.max(1, this.lastLine), 'the file has no header');
    this.headerLine = line.number;
    const { words } = line;
    if (words.length < 4) {
      fail('malformed', line.number, 'the header must be: version, name, frames per second, number of frames');
    }
    if (!['2.0', '2.1', '2.2'].includes(words[0]!)) {
      const version = readFapNumber(words[0]!);
      if (version === null) failAt('malformed', line, 0, `${quoted(words[0]!)} is no version of a .fap file, as 2.1 is`);
      this.note('other_version', line.number);
    }
    const at = words.length - 2;
    const rate = this.number(line, at);
    if (!(rate >= 0.001 && rate <= 1000)) {
      failAt('out_of_range', line, at, 'the frames per second must be 0.001 to 1000');
    }
    if (at > 2) this.note('blank_in_name', line.number);
    const name = words.slice(1, at).join('_').replace(/[^\x21-\x5e\x60-\x7e]+/g, '_').slice(0, maxNameLength);
    return { rate, name, count: this.number(line, at + 1) };
  }

  private readMask(line: Line): number[] {
    const present: number[] = [];
    line.words.forEach((word, i) => {
      if (i > fapCount) failAt('malformed', line, i, 'a mask has 68 flags (69 are taken), this has more');
      if (word !== '0' && word !== '1') failAt('malformed', line, i, `a flag of a mask is 0 or 1, not ${quoted(word)}`);
      if (i < fapCount && word === '1') present.push(i + 1);
    });
    if (line.words.length < fapCount) {
      fail('malformed', line.number, `a mask must have 68 flags (69 are accepted), not ${line.words.length}`);
    }
    if (line.words.length > fapCount) this.note('extra_flag', line.number);
    return present;
  }

  private readValues(line: Line, flags: number[]): FapFileFrame {
    const { words } = line;
    const number = this.number(line, 0);
    if (!(number >= 0 && number <= 2 * fapFileLimits.numbers) || !Number.isInteger(number)) {
      failAt('out_of_range', line, 0, `${quoted(words[0]!)} is no frame number`);
    }
    const frame: FapFileFrame = { number, present: [], values: new Float64Array(fapCount + 1) };
    const hasViseme = flags.includes(1);
    const hasExpression = flags.includes(2);
    const others = flags.length - Number(hasViseme) - Number(hasExpression);
    // Some files write FAPs 1 and 2 as one number each; the count of numbers is unambiguous.
    const given = words.length - 1;
    let viseme = hasViseme ? visemeFields : 0;
    let expression = hasExpression ? expressionFields : 0;
    for (const v of hasViseme ? [visemeFields, 1] : [0]) {
      for (const e of hasExpression ? [expressionFields, 1] : [0]) {
        if (v + e + others === given) [viseme, expression] = [v, e];
      }
    }
    if (given < viseme + expression + others) this.note('few_values', line.number);
    if (given > viseme + expression + others) this.note('more_values', line.number);

    let at = 1;
    const fields = (count: number): number[] | null => {
      const read: number[] = [];
      for (; read.length < count && at < words.length; at += 1) read.push(this.number(line, at));
      return read.length < count ? null : read;
    };
    if (hasViseme) {
      const read = fields(viseme);
      const meant = read && this.viseme(line, read);
      if (meant) {
        frame.viseme = meant;
        frame.present.push(1);
      }
    }
    if (hasExpression) {
      const read = fields(expression);
      const meant = read && this.expression(line, read);
      if (meant) {
        frame.expression = meant;
        frame.present.push(2);
      }
    }
    for (const fap of flags) {
      if (fap < firstLowLevelFap || at >= words.length) continue;
      frame.present.push(fap);
      frame.values[fap] = this.value(line, at);
      at += 1;
    }
    // Extra values are dropped, but must be numbers: otherwise this is not a line of values.
    for (; at < words.length; at += 1) this.number(line, at);
    return frame;
  }

  private value(line: Line, word: number): number {
    const value = this.number(line, word);
    if (!Number.isFinite(value)) {
      this.note('not_finite', line.number);
      return 0;
    }
    if (Math.abs(value) > maxValue) {
      failAt('out_of_range', line, word, `${quoted(line.words[word]!)} is beyond 1e9 FAP units`);
    }
    return value;
  }

  private strength(line: Line, value: number): number {
    if (!(value >= 0 && value <= maxBlend)) {
      this.note('strength_out_of_range', line.number);
      return value > maxBlend ? maxBlend : 0;
    }
    if (!Number.isInteger(value)) this.note('strength_not_whole', line.number);
    return Math.floor(value + 0.5);
  }

  private viseme(line: Line, fields: number[]): FapFileViseme | null {
    const [first, select2, blend, viseme_def] = fields as [number, number, number, number];
    if (fields.length > 1) {
      if (whole(first, maxViseme) && whole(select2, maxViseme) && whole(viseme_def, 1)) {
        return { select1: first, select2, blend: this.strength(line, blend), viseme_def };
      }
    } else if (whole(first, maxViseme)) {
      this.note('single_number_viseme', line.number);
      return { select1: first, select2: 0, blend: maxBlend, viseme_def: 0 };
    } else {
      const packed = first - packedBase;
      const unpacked = [Math.floor(packed / 10_000), Math.floor(packed / 100) % 100, packed % 100] as const;
      if (whole(unpacked[0], maxViseme) && whole(unpacked[1], maxViseme) && whole(unpacked[2], maxBlend)) {
        this.note('packed_viseme', line.number);
        return { select1: unpacked[0], select2: unpacked[1], blend: unpacked[2], viseme_def: 0 };
      }
    }
    this.note('unknown_select', line.number);
    return null;
  }

  private expression(line: Line, fields: number[]): FapFileExpression | null {
    const [select1, intensity1, select2, intensity2, init_face, expression_def] = fields as [
      number, number, number, number, number, number,
    ];
    if (fields.length === 1 && whole(select1, maxExpression)) {
      this.note('single_number_expression', line.number);
      return { select1, intensity1: maxBlend, select2: 0, intensity2: 0, init_face: 0, expression_def: 0 };
    }
    const known = whole(select1, maxExpression) && whole(select2, maxExpression);
    if (fields.length > 1 && known && whole(init_face, 1) && whole(expression_def, 1)) {
      const first = this.strength(line, intensity1);
      return { select1, intensity1: first, select2, intensity2: this.strength(line, intensity2), init_face, expression_def };
    }
    this.note('unknown_select', line.number);
    return null;
  }

  /** Sorts by number, starting from 0; of frames with equal numbers the later in the file is kept. */
  private ordered(): FapFileFrame[] {
    for (let i = 1; i < this.frames.length; i += 1) {
      const { frame, line } = this.frames[i]!;
      if (frame.number <= this.frames[i - 1]!.frame.number) this.note('numbers_not_rising', line);
    }
    const byNumber = new Map(this.frames.map(({ frame }) => [frame.number, frame]));
    const frames = [...byNumber.values()].sort((a, b) => a.number - b.number);
    const first = frames[0]!.number;
    if (first !== 0) this.note('first_number_not_zero', this.frames[0]!.line);
    if (frames.at(-1)!.number - first > fapFileLimits.numbers) {
      fail('out_of_range', this.frames.at(-1)!.line, `the frame numbers span more than ${fapFileLimits.numbers}`);
    }
    frames.forEach((frame) => (frame.number -= first));
    for (let i = 1; i < frames.length; i += 1) {
      if (frames[i]!.number !== frames[i - 1]!.number + 1) this.note('numbers_left_out', this.headerLine);
    }
    return frames;
  }
}

function whole(value: number, most: number): boolean {
  return Number.isInteger(value) && value >= 0 && value <= most;
}

/** Reads a .fap file. Throws ProtocolError; its `where` is "line 12" or "line 12, word 3". */
export function parseFap(text: string | Uint8Array): FapFileReading {
  if (text.length > fapFileLimits.bytes) {
    throw new ProtocolError('too_large', '', `a .fap file has at most ${fapFileLimits.bytes} bytes`);
  }
  return new Reader(typeof text === 'string' ? text : new TextDecoder('utf-8', { ignoreBOM: true }).decode(text)).read();
}

/** Writes version 2.1, 68 flags, frames from 0, LF, one blank as separator. `parseFap` returns an equal file. */
export function writeFap(file: FapFile): string {
  let text = `2.1 ${file.name === '' ? 'semblante' : file.name} ${file.rate} ${file.frames.length}\n`;
  for (const { number, present, viseme, expression, values } of file.frames) {
    const flags = new Array<number>(fapCount).fill(0);
    for (const fap of present) flags[fap - 1] = 1;
    const words = [number];
    if (viseme) words.push(viseme.select1, viseme.select2, viseme.blend, viseme.viseme_def);
    if (expression) {
      words.push(expression.select1, expression.intensity1, expression.select2, expression.intensity2);
      words.push(expression.init_face, expression.expression_def);
    }
    // + 0 turns -0 into 0. JavaScript prints all allowed values without an exponent, in the shortest form.
    for (const fap of present) if (fap >= firstLowLevelFap) words.push(values[fap]! + 0);
    text += `${flags.join(' ')}\n${words.join(' ')}\n`;
  }
  return text;
}
