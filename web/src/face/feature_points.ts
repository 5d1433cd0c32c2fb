import { featurePoints, type FeaturePoint } from '@protocol/generated/mpeg4.ts';

export interface PointGroup {
  number: number;
  name: string;
  points: readonly FeaturePoint[];
}

const names: Record<number, string> = {
  2: 'Chin and inner lips',
  3: 'Eyes',
  4: 'Eyebrows',
  5: 'Cheeks',
  6: 'Tongue',
  7: 'Spine',
  8: 'Outer lips',
  9: 'Nose and teeth',
  10: 'Ears',
  11: 'Hair',
};

export const groupOf = (id: string): number => Number(id.split('.')[0]);

/** The 84 feature points by group, in the standard's order. */
export const pointGroups: readonly PointGroup[] = Object.keys(names).map((key) => {
  const number = Number(key);
  return { number, name: names[number]!, points: featurePoints.filter((point) => groupOf(point.id) === number) };
});

const byId = new Map(featurePoints.map((point) => [point.id, point]));
export const pointById = (id: string): FeaturePoint | undefined => byId.get(id);
