import { t } from '../../words/words.ts';

/** What is done with the pointer of this device: with a finger one taps. */
export const clickWord = (): string => (matchMedia('(pointer: coarse)').matches ? t('tap') : t('click'));
