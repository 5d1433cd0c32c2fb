import { lastLowLevelFap, maxBlend } from '../face_frame.ts';
import { expressionSets, visemeSets, type DisplacementSet } from '../generated/displacement_sets.ts';
import { faps, featurePoints } from '../generated/mpeg4.ts';
import type { FaceValues } from './face_values.ts';

/** The viseme share (Eq. 5: weight of the viseme where an expression acts too). float32, as in all implementations. */
const visemeShare = Math.fround(0.85);

const pointIndex = new Map(featurePoints.map((point, index) => [point.id, index]));

const denseOf = (set: DisplacementSet): Float64Array => {
  const dense = new Float64Array(featurePoints.length * 3);
  for (const [point, x, y, z] of set.displacements) dense.set([x, y, z], 3 * point);
  return dense;
};
const visemes = visemeSets.map(denseOf);
const expressions = expressionSets.map(denseOf);

interface Axis {
  fap: number;
  sign: number;
  point: number;
  component: number;
}
const axes: readonly Axis[] = faps
  .filter((fap) => fap.kind === 'translation')
  .map((fap) => {
    const point = pointIndex.get(fap.featurePoints[0]!)!;
    return { fap: fap.number, sign: fap.sign, point, component: 3 * point + fap.axis! };
  });

type Blend = (component: number) => number;
const blendOf = (sets: Float64Array[], first: number, firstWeight: number, second: number, secondWeight: number): Blend => {
  const a = sets[first];
  const b = sets[second];
  return (component) => (a ? firstWeight * a[component]! : 0) + (b ? secondWeight * b[component]! : 0);
};
const moves = (blend: Blend, point: number): boolean =>
  blend(3 * point) !== 0 || blend(3 * point + 1) !== 0 || blend(3 * point + 2) !== 0;

const shareOf63 = (value: number): number => Math.min(value, maxBlend) / maxBlend;

/**
 * The displacement of each FAP's feature point along the FAP's axis, by FAP number, FAP units, on a head with the
 * library's visemes and expressions. Eq. 5 combines FAPs 1 and 2; nonzero low-level FAPs override both.
 */
export function axisDisplacements({ viseme, expression, faps: own }: FaceValues): Float64Array {
  const share = shareOf63(viseme.blend);
  const spoken = blendOf(visemes, viseme.select1, share, viseme.select2, 1 - share);
  const felt = blendOf(
    expressions,
    expression.select1,
    shareOf63(expression.intensity1),
    expression.select2,
    shareOf63(expression.intensity2),
  );
  const result = new Float64Array(lastLowLevelFap + 1);
  result.set(own);
  for (const { fap, sign, point, component } of axes) {
    if (own[fap] !== 0) continue;
    const both = moves(spoken, point) && moves(felt, point);
    result[fap] =
      sign * ((both ? visemeShare : 1) * spoken(component) + (both ? 1 - visemeShare : 1) * felt(component));
  }
  return result;
}
