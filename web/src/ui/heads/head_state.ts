import { quickSet } from '../../face/quick_set.ts';
import type { Model } from '../../net/types.ts';
import { t } from '../../words/words.ts';

const words: Record<Model['state'], string> = {
  importing: t('Importing'),
  ready: t('Needs points'),
  parametrized: t('Ready to animate'),
  failed: t('Failed'),
};

/** What a head is ready for, or what it waits for. */
export const stateInWords = ({ state, feature_point_count }: Model): string =>
  state === 'ready' && feature_point_count >= quickSet.length ? t('Has points, does not move yet') : words[state];
