/** A line of a document, shortened around the error. */
export interface ExcerptLine {
  number: number;
  text: string;
  /** Whether the error is on this line. */
  marked: boolean;
}

const around = 1;
const longestLine = 72;

/**
 * The lines around the place of an error: a JSON pointer (`/cues/3/viseme`), or `line 12, word 3` of a .fap file.
 * Empty when the text has no such place. For a missing member, the place is the object that lacks it.
 */
export function excerptAt(text: string, where: string | undefined): ExcerptLine[] {
  if (where === undefined) return [];
  const offset = where.startsWith('/') ? offsetOfPointer(text, where) : offsetOfLine(text, where);
  if (offset === null) return [];
  const lines = text.split(/\r\n|\n|\r/);
  const before = text.slice(0, offset).split(/\r\n|\n|\r/);
  const line = before.length - 1;
  const column = before[line]!.length;
  const excerpt: ExcerptLine[] = [];
  for (let i = Math.max(0, line - around); i <= Math.min(lines.length - 1, line + around); i += 1)
    excerpt.push({ number: i + 1, text: shorten(lines[i]!, i === line ? column : 0), marked: i === line });
  return excerpt;
}

/** Keeps the text around `column`: a document may be a single line of a megabyte. */
function shorten(line: string, column: number): string {
  if (line.length <= longestLine) return line;
  const begin = Math.max(0, Math.min(column - longestLine / 3, line.length - longestLine));
  const from = Math.floor(begin);
  const to = from + longestLine;
  return `${from > 0 ? '…' : ''}${line.slice(from, to)}${to < line.length ? '…' : ''}`;
}

function offsetOfLine(text: string, where: string): number | null {
  const match = /^line (\d+)(?:, word (\d+))?$/.exec(where);
  if (!match) return null;
  const ends = /\r\n|\n|\r/g;
  let begin = 0;
  for (let line = Number(match[1]); line > 1; line -= 1) {
    if (!ends.exec(text)) return null;
    begin = ends.lastIndex;
  }
  const words = /\S+/g;
  words.lastIndex = begin;
  let at = begin;
  for (let word = Number(match[2] ?? 0); word > 0; word -= 1) at = words.exec(text)?.index ?? at;
  return at;
}

/** The offset of the pointer's value; null when the text is not valid JSON up to there. */
function offsetOfPointer(text: string, pointer: string): number | null {
  let at = skipBlanks(text, 0);
  for (const part of pointer.split('/').slice(1)) {
    const inside = memberOf(text, at, part.replaceAll('~1', '/').replaceAll('~0', '~'));
    if (inside === null) break;
    at = inside;
  }
  return at < text.length ? at : null;
}

function memberOf(text: string, at: number, key: string): number | null {
  const object = text[at] === '{';
  if (!object && text[at] !== '[') return null;
  let i = skipBlanks(text, at + 1);
  for (let index = 0; i < text.length && text[i] !== '}' && text[i] !== ']'; index += 1) {
    let name = String(index);
    if (object) {
      const end = skipString(text, i);
      name = nameOf(text.slice(i, end));
      i = skipBlanks(text, skipBlanks(text, end) + 1);
    }
    if (name === key) return i;
    const end = skipBlanks(text, skipValue(text, i));
    if (end <= i) return null;
    i = text[end] === ',' ? skipBlanks(text, end + 1) : end;
  }
  return null;
}

function nameOf(quoted: string): string {
  try {
    return String(JSON.parse(quoted));
  } catch {
    return quoted;
  }
}

function skipBlanks(text: string, at: number): number {
  let i = at;
  while (i < text.length && /\s/.test(text[i]!)) i += 1;
  return i;
}

function skipString(text: string, at: number): number {
  if (text[at] !== '"') return at;
  let i = at + 1;
  while (i < text.length && text[i] !== '"') i += text[i] === '\\' ? 2 : 1;
  return Math.min(i + 1, text.length);
}

/** Counts brackets instead of recursing: the nesting depth of the document is not limited. */
function skipValue(text: string, at: number): number {
  let depth = 0;
  let i = at;
  while (i < text.length) {
    const c = text[i]!;
    if (c === '"') {
      i = skipString(text, i);
      if (depth === 0) return i;
      continue;
    }
    if (c === '{' || c === '[') depth += 1;
    else if (c === '}' || c === ']') {
      if (depth === 0) return i;
      depth -= 1;
      if (depth === 0) return i + 1;
    } else if (c === ',' && depth === 0) return i;
    i += 1;
  }
  return i;
}
