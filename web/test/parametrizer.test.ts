import { expect, test } from 'vitest';
import type { Model, ParametrizationOptions } from '../src/net/types.ts';
import { Parametrizer } from '../src/ui/points/parametrizer.ts';
import type { PointsModel } from '../src/ui/points/points_model.ts';
import { Signal } from '../src/ui/shared/signal.ts';
import type { Studio } from '../src/ui/shared/studio.ts';
import { importingModel } from './support/models.ts';

function recorder(): { parametrizer: Parametrizer; asked: ParametrizationOptions[] } {
  const asked: ParametrizationOptions[] = [];
  const studio = {
    selected: new Signal<Model | null>(importingModel({ state: 'ready' })),
    parametrize: (_model: Model, options: ParametrizationOptions) => {
      asked.push(options);
      return Promise.resolve(false);
    },
  } as unknown as Studio;
  const points = { draft: { changes: 0 } } as unknown as PointsModel;
  return { parametrizer: new Parametrizer(studio, points), asked };
}

test('Run_NothingChosen_AsksForTheLevelsThatSuitTheHead', async () => {
  const { parametrizer, asked } = recorder();
  await parametrizer.run();
  // Left out, `lods` means none: see openapi.json. Left out, `articulation` is that of the head's own shapes.
  expect(asked).toEqual([{ weights: 'smooth', metric: 'edge', expressions: 'library', lods: 'auto' }]);
});

test('SetArticulation_IsSent_UntilItIsTheHeadsOwnAgain', async () => {
  const { parametrizer, asked } = recorder();
  parametrizer.setArticulation(2.5);
  await parametrizer.run();
  expect(asked[0]).toMatchObject({ articulation: 2.5, weights: 'smooth' });
  parametrizer.setArticulation(null);
  await parametrizer.run();
  expect(asked[1]).not.toHaveProperty('articulation');
});
