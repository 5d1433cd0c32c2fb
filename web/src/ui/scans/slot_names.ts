import { expressions, visemes } from '@protocol/generated/mpeg4.ts';
import { capital } from '../shared/names.ts';
import { nameOf, t } from '../../words/words.ts';

/** A place for a set of displacements: a viseme or an expression, without those of the face at rest. */
export interface Slot {
  name: string;
  kind: 'viseme' | 'expression';
  title: string;
}

export const slots: readonly Slot[] = [
  ...expressions.slice(1).map(({ name }): Slot => ({ name, kind: 'expression', title: nameOf(capital(name)) })),
  ...visemes.slice(1).map(({ name, phonemes, examples }): Slot => ({
    name,
    kind: 'viseme',
    title: t('Viseme {sounds} ({word})', { sounds: phonemes.join(' '), word: examples[0] ?? name }),
  })),
];

export const slotTitle = (name: string): string => slots.find((slot) => slot.name === name)?.title ?? name;

/** Words that name an expression in the names of files. */
const synonyms: Readonly<Record<string, readonly string[]>> = {
  joy: ['joy', 'joyful', 'happy', 'happiness', 'smile', 'smiling', 'alegria', 'feliz', 'sorriso'],
  sadness: ['sadness', 'sad', 'tristeza', 'triste'],
  anger: ['anger', 'angry', 'rage', 'raiva', 'zangado', 'zangada'],
  fear: ['fear', 'afraid', 'scared', 'medo'],
  disgust: ['disgust', 'disgusted', 'nojo'],
  surprise: ['surprise', 'surprised', 'surpresa'],
};

/** The place that the name of a scan's file tells ("Ana_smile.obj", "viseme-p_b_m.obj"); null: none. */
export function slotOfFile(fileName: string): string | null {
  const stem = fileName.replace(/\.[a-z0-9]+$/i, '').toLowerCase();
  const words = new Set(stem.split(/[^\p{L}]+/u));
  for (const [slot, names] of Object.entries(synonyms)) if (names.some((name) => words.has(name))) return slot;
  const viseme = /(?:^|viseme[\s._-]*)([a-z]+(?:_[a-z]+)*)$/.exec(stem)?.[1];
  return slots.find(({ kind, name }) => kind === 'viseme' && name === viseme)?.name ?? null;
}
