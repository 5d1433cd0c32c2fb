import type { FacePackage, Model } from '../../net/types.ts';
import { metricChoices, weightChoices } from '../points/parametrize_options.ts';
import { formatCount } from '../shared/format.ts';
import { t } from '../../words/words.ts';

type Method = Pick<FacePackage, 'weights' | 'metric'>;

/** "Smooth skin, along edges". */
export function methodTitle({ weights, metric }: Method): string {
  const kind = weightChoices.find(({ value }) => value === weights)?.title ?? weights;
  const distance = metricChoices.find(({ value }) => value === metric)?.title ?? metric;
  return `${kind}, ${distance.toLocaleLowerCase()}`;
}

/** "Full mesh, 5,120 vertices". */
export function levelTitle(lod: number, vertices: number): string {
  return t('{level}, {count} vertices', {
    level: lod === 0 ? t('Full mesh') : t('Level {lod}', { lod }),
    count: formatCount(vertices),
  });
}

/** A head at a level of detail. */
export interface ShownFace {
  model: Model;
  level: number;
}

/** What is seen of a head: its name, its weights, its level of detail; null: not known. */
const factsOf = ({ model, level }: ShownFace): (string | null)[] => {
  const made = model.package?.levels.find(({ lod }) => lod === level);
  return [model.name, model.package ? methodTitle(model.package) : null, made ? levelTitle(level, made.vertices) : null];
};

/** "Anna · Smooth skin, along edges · Full mesh, 5,120 vertices". */
export const faceCaption = (face: ShownFace): string => factsOf(face).filter((fact) => fact !== null).join(' · ');

/** What tells a face from the one beside it; everything, where nothing does. Of another head the name alone is enough. */
export function differenceFrom(face: ShownFace, other: ShownFace): string {
  if (face.model.id !== other.model.id && face.model.name !== other.model.name) return face.model.name;
  const others = factsOf(other);
  const different = factsOf(face).filter((fact, i) => fact !== null && fact !== others[i]);
  return different.length > 0 ? different.join(' · ') : faceCaption(face);
}
