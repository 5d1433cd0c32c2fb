import { expect, test } from 'vitest';
import type { Model, ParametrizationOptions } from '../src/net/types.ts';
import { Parametrizer } from '../src/ui/points/parametrizer.ts';
import type { PointsModel } from '../src/ui/points/points_model.ts';
import { Signal } from '../src/ui/shared/signal.ts';
import type { Studio } from '../src/ui/shared/studio.ts';
import { importingModel } from './support/models.ts';

test('Run_NothingChosen_AsksForTheLevelsThatSuitTheHead', async () => {
  const asked: ParametrizationOptions[] = [];
  const studio = {
    selected: new Signal<Model | null>(importingModel({ state: 'ready' })),
    parametrize: (_model: Model, options: ParametrizationOptions) => {
      asked.push(options);
      return Promise.resolve(false);
    },
  } as unknown as Studio;
  const points = { draft: { changes: 0 } } as unknown as PointsModel;
  await new Parametrizer(studio, points).run();
  // Left out, `lods` means none: see openapi.json.
  expect(asked).toEqual([
    { weights: 'smooth', metric: 'edge', articulation: 1, expressions: 'library', lods: 'auto' },
  ]);
});
