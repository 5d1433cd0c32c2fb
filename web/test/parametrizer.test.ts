import { expect, test } from 'vitest';
import type { Model, ParametrizationOptions } from '../src/net/types.ts';
import { Parametrizer } from '../src/ui/points/parametrizer.ts';
import type { PointsModel } from '../src/ui/points/points_model.ts';
import { Signal } from '../src/ui/shared/signal.ts';
import type { Studio, Tab } from '../src/ui/shared/studio.ts';
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

test('Mend_Places_AreMovedToBeforeTheHeadIsParametrized_AndErrorsThatStayLeadNobodyAside', async () => {
  const head = importingModel({ id: 'ana', state: 'parametrized', findings: { errors: 1, warnings: 0, notes: 0 } });
  const done: string[] = [];
  const studio = {
    selected: new Signal<Model | null>(head),
    models: new Signal([head]),
    tab: new Signal<Tab>('fit'),
    toasts: { say: (text: string) => done.push(text) },
    parametrize: () => Promise.resolve(done.push('parametrized') > 0),
  } as unknown as Studio;
  const draft = { changes: 0 };
  const points = {
    draft,
    moveAll: (places: [string, unknown][]) => (draft.changes = places.length),
    save: () => Promise.resolve(done.push(`saved ${draft.changes}`) > 0),
  } as unknown as PointsModel;
  await new Parametrizer(studio, points).mend([{ point: '2.6', vertex: 1, position: [0, 0, 0] }]);
  expect(done).toEqual(['saved 1', 'parametrized', 'Ada is ready to animate. The fit doctor found 1 error.']);
  expect(studio.tab.value).toBe('animate');
});
