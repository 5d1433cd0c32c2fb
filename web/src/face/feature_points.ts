import { featurePointNames, featurePoints, type FeaturePoint } from '@protocol/generated/mpeg4.ts';
import { nameOf, t } from '../words/words.ts';

export interface NamedPoint extends FeaturePoint {
  readonly name: string;
}

export interface PointGroup {
  number: number;
  name: string;
  points: readonly NamedPoint[];
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
const named: readonly NamedPoint[] = featurePoints.map((point, index) => ({ ...point, name: nameOf(featurePointNames[index]!) }));

/** The 84 feature points by group, in the standard's order. */
export const pointGroups: readonly PointGroup[] = Object.keys(names).map((key) => {
  const number = Number(key);
  return { number, name: names[number]!, points: named.filter((point) => groupOf(point.id) === number) };
});

const byId = new Map(named.map((point) => [point.id, point]));
export const pointById = (id: string): NamedPoint | undefined => byId.get(id);
