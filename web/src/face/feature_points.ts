import { featurePoints, type FeaturePoint } from '@protocol/generated/mpeg4.ts';
import { nameOf, t } from '../words/words.ts';

export interface PointGroup {
  number: number;
  name: string;
  points: readonly FeaturePoint[];
}

const names: Record<number, string> = {
  2: t('Chin and inner lips'),
  3: t('Eyes'),
  4: t('Eyebrows'),
  5: t('Cheeks'),
  6: t('Tongue'),
  7: t('Spine'),
  8: t('Outer lips'),
  9: t('Nose and teeth'),
  10: t('Ears'),
  11: t('Hair'),
};

export const groupOf = (id: string): number => Number(id.split('.')[0]);

/** The 84 feature points, named in the language of the page. */
const named = featurePoints.map((point) => ({ ...point, name: nameOf(point.name) }));

/** The 84 feature points by group, in the standard's order. */
export const pointGroups: readonly PointGroup[] = Object.keys(names).map((key) => {
  const number = Number(key);
  return { number, name: names[number]!, points: named.filter((point) => groupOf(point.id) === number) };
});

const byId = new Map<string, FeaturePoint>(named.map((point) => [point.id, point]));
export const pointById = (id: string): FeaturePoint | undefined => byId.get(id);
