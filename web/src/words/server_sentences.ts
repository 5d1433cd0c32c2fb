/**
 * Sentences of the server in another language by their English form; `{names}` stand for what the server fills in: `numbers` for
 * digits, `measures` for what is measured, with a decimal comma (limits stand as in the document that they are of), `parts` for
 * another sentence of the table; no other value has a semicolon.
 */
export type Sentences = Readonly<Record<string, string>>;

const numbers = new Set(['number', 'count', 'line']);
const measures = new Set(['length', 'height', 'millimetres', 'tilt', 'share', 'weight', 'rate']);
const parts = new Set(['remark', 'fault', 'reason', 'stance', 'remedy', 'faps', 'pace', 'wanted', 'found', 'quota', 'role', 'times', 'sides', 'upper', 'lower']);

interface Pattern {
  shape: RegExp;
  names: readonly string[];
  text: string;
}

const escaped = (text: string): string => text.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');

function patternOf(english: string, text: string): Pattern {
  const pieces = english.split(/\{(\w+)\}/);
  const source = pieces.map((piece, index) => (index % 2 === 0 ? escaped(piece) : parts.has(piece) ? '(.+?)' : numbers.has(piece) ? '(\\d+)' : '([^;]+?)')).join('');
  return { shape: new RegExp(`^${source}$`, 's'), names: pieces.filter((_, index) => index % 2 === 1), text };
}

/** A number of the server with the decimal comma of the tables' languages. */
const withComma = (measure: string): string => measure.replace(/^(-?\d+)\.(\d+)$/, '$1,$2');

const lengthOfWords = (english: string): number => english.replace(/\{\w+\}/g, '').length;

/** Gives a sentence of the server by the table; null: the table does not have it, or a part of it. */
export function sentenceTranslator(table: Sentences): (english: string) => string | null {
  // Of two that fit, the one with more words of its own says more.
  const patterns = Object.entries(table)
    .filter(([english]) => english.includes('{'))
    .sort(([a], [b]) => lengthOfWords(b) - lengthOfWords(a))
    .map(([english, text]) => patternOf(english, text));
  const translate = (english: string): string | null => {
    if (Object.hasOwn(table, english)) return table[english]!;
    for (const { shape, names, text } of patterns) {
      const found = shape.exec(english);
      if (!found) continue;
      const said = (name: string, value: string): string | null => (parts.has(name) ? translate(value) : measures.has(name) ? withComma(value) : value);
      const values = new Map(names.map((name, index) => [name, said(name, found[index + 1]!)]));
      if ([...values.values()].includes(null)) continue;
      return text.replace(/\{(\w+)\}/g, (_, name: string) => values.get(name)!);
    }
    return null;
  };
  return translate;
}
