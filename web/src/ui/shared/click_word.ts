import { t } from '../../words/words.ts';

/** Whether the pointer of this device is a finger, which drops no files. */
export const hasFinger = (): boolean => matchMedia('(pointer: coarse)').matches;

/** What is done with the pointer of this device: with a finger one taps. */
export const clickWord = (): string => (hasFinger() ? t('tap') : t('click'));
