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

/** What is seen of a head: its name, its weights, its level of detail. */
export function faceCaption(model: Model, lod: number): string {
  const parts = [model.name];
  if (model.package) parts.push(methodTitle(model.package));
  const level = model.package?.levels.find((one) => one.lod === lod);
  if (level) parts.push(levelTitle(lod, level.vertices));
  return parts.join(' · ');
}
