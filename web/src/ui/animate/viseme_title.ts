import type { Viseme } from '@protocol/generated/mpeg4.ts';
import { t, visemeWords } from '../../words/words.ts';

/** A viseme by its sounds, with a word that has them: "s z (sir)". */
export const visemeTitle = ({ name, phonemes, examples }: Viseme): string =>
  phonemes.length === 0 ? t('Silence') : `${phonemes.join(' ')} (${visemeWords(name, examples)[0] ?? name})`;
