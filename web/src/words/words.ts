import { changeLanguage, language, languageOf, languages, type Language } from '../../kept/language.ts';
import type { portuguese } from './portuguese.ts';
import type { FindingFacts } from './portuguese_findings.ts';

/** Every text of the studio, in English, as the tables of the other languages list them. */
export type Text = keyof typeof portuguese;

export { changeLanguage, language, languageOf, languages, type Language };

// A table is loaded only for its language.
const table: Readonly<Record<Text, string>> | null =
  language === 'pt-BR' ? (await import('./portuguese.ts')).portuguese : null;
const problems = language === 'pt-BR' ? (await import('./portuguese_problems.ts')).portugueseProblems : null;
const findings = language === 'pt-BR' ? await import('./portuguese_findings.ts') : null;
const standard = language === 'pt-BR' ? await import('./portuguese_names.ts') : null;

/** A text in the language of the page, with its `{names}` replaced by values. */
export function t(text: Text, values: Readonly<Record<string, string | number>> = {}): string {
  return (table?.[text] ?? text).replace(/\{(\w+)\}/g, (whole, name: string) => shown(values[name] ?? whole));
}

/** Made once: toLocaleString() would make one for each number of a list. */
const number = new Intl.NumberFormat(language, { useGrouping: false, maximumFractionDigits: 20 });

const fromRightToLeft = /[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc]/;

/**
 * Numbers with the language's decimal sign; who wants digits in groups says so (`formatCount`). Names written from right to left
 * between the characters that isolate them, so that the words around them keep their order.
 */
const shown = (value: string | number): string => {
  if (typeof value === 'number') return number.format(value);
  return fromRightToLeft.test(value) ? `\u2068${value}\u2069` : value;
};

/** A name of the standard's tables, or the title of a finding, in the language of the page. */
export const nameOf = (english: string): string => standard?.portugueseNames[english] ?? english;

/** Words with the sounds of a viseme in the language of the page; `english` are the standard's. */
export const visemeWords = (name: string, english: readonly string[]): readonly string[] => standard?.portugueseVisemeWords[name] ?? english;

/** The title of a kind of the server's problems (the end of its `type`) in the language of the page; null: it stays as the server wrote it. */
export const problemTitle = (slug: string): string | null => problems?.[slug] ?? null;

let sentences: ((english: string) => string | null) | null = null;

/** Loads the translations of the server's sentences, which the first picture does not need; whether there are any. Without a network they stay in English. */
export async function loadServerWords(): Promise<boolean> {
  if (language !== 'pt-BR') return false;
  sentences ??= (await import('./portuguese_sentences.ts').catch(() => null))?.portugueseSentence ?? null;
  return sentences !== null;
}

/** A sentence of the server, as the detail of a problem or a remark on a file, in the language of the page; what has no translation stays in English. */
export const serverWords = (english: string): string => sentences?.(english) ?? english;

/** The words and the remedy of a finding in the language of the page; null: they stay as the server wrote them. */
export const findingTexts = (code: string, facts: FindingFacts): readonly [words: string, remedy: string] | null =>
  findings?.portugueseFindings[code]?.(facts) ?? null;

/** What a finding measured, in the language of the page. */
export const measureName = (english: string): string => findings?.portugueseMeasure(english) ?? english;
