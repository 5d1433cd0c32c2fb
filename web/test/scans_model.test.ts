import { beforeEach, expect, test } from 'vitest';
import type { Api } from '../src/net/api.ts';
import type { ExtractionOptions, Job, Model, WornEdit } from '../src/net/types.ts';
import { ScansModel } from '../src/ui/scans/scans_model.ts';
import { slotOfFile } from '../src/ui/scans/slot_names.ts';
import { Studio } from '../src/ui/shared/studio.ts';
import type { Toasts } from '../src/ui/shared/toast.ts';
import { importingModel } from './support/models.ts';

const ana: Model = importingModel({ id: 'ana', name: 'Ana', state: 'parametrized' });
const file = (name: string): File => new File(['v 0 0 0'], name);

let asked: (ExtractionOptions & { file: string })[];
let worn: WornEdit[];
let deleted: string[];
let said: string[];
let model: ScansModel;
let studio: Studio;

beforeEach(() => {
  [asked, worn, deleted, said] = [[], [], [], []];
  const api = {
    createExpression: (options: ExtractionOptions, scan: File): Promise<Job> => {
      asked.push({ ...options, file: scan.name });
      const bad = scan.name.startsWith('other');
      return Promise.resolve({
        id: 'j',
        state: bad ? 'failed' : 'done',
        problem: bad ? { type: '/problems/invalid-field', title: 'wrong', status: 422, detail: 'it has 25 vertices, the neutral head 81' } : null,
        result: bad ? null : { expression: `set of ${scan.name}` },
      } as unknown as Job);
    },
    wear: (_: string, edit: WornEdit) => {
      worn.push(edit);
      return Promise.resolve({ model: ana, job: null });
    },
    deleteExpression: (id: string) => Promise.resolve(void deleted.push(id)),
    getModel: () => Promise.resolve(ana),
  };
  studio = new Studio(api as unknown as Api, { say: (words: string) => said.push(words), problem: () => undefined } as unknown as Toasts);
  model = new ScansModel(studio);
  studio.selected.set(ana);
});

test.each([
  ['Ana_smile.obj', 'joy'],
  ['raiva.ply', 'anger'],
  ['viseme-p_b_m.obj', 'p_b_m'],
  ['a.obj', 'a'],
  ['ana.obj', null],
  ['unhappyish.obj', null],
])('Slot_OfTheFile %s_Is %s', (name, slot) => expect(slotOfFile(name)).toBe(slot));

test('Scans_SeveralFiles_BecomeTheExpressionsThatTheyShow', async () => {
  model.add([file('smile.obj'), file('p_b_m.obj'), file('nameless.obj')]);
  await model.wear();
  expect(asked.map(({ file: name, model: of, kind, align, least }) => [name, of, kind, align, least])).toEqual([
    ['smile.obj', 'ana', 'expression', true, undefined],
    ['p_b_m.obj', 'ana', 'viseme', true, 50],
  ]);
  expect(worn).toEqual([{ joy: 'set of smile.obj', p_b_m: 'set of p_b_m.obj' }]);
  expect(deleted).toEqual(['set of smile.obj', 'set of p_b_m.obj']); // the head has a copy
  expect(model.scans.value.map(({ file: { name } }) => name)).toEqual(['nameless.obj']);
  expect(said).toEqual(['2 expressions are its own now.']);
});

test('Scans_OneThatCannotBeRead_StaysWithTheReason', async () => {
  model.add([file('other_joy.obj'), file('fear.obj')]);
  await model.wear();
  expect(worn).toEqual([{ fear: 'set of fear.obj' }]);
  expect(model.scans.value.map(({ slot, fault }) => [slot, fault])).toEqual([['joy', 'it has 25 vertices, the neutral head 81']]);
});

test('Scans_OfOnePlace_OnlyOneHasIt', () => {
  model.add([file('smile.obj'), file('happy.obj')]);
  expect(model.scans.value.map(({ slot }) => slot)).toEqual(['joy', null]);
  model.place(model.scans.value[1]!, 'joy');
  expect(model.scans.value.map(({ slot }) => slot)).toEqual([null, 'joy']);
});

test('Scans_OfAnotherHead_AreNotKept', () => {
  model.add([file('smile.obj')]);
  studio.selected.set({ ...ana, feature_point_count: 3 });
  expect(model.scans.value).toHaveLength(1);
  studio.selected.set({ ...ana, id: 'eva' });
  expect(model.scans.value).toEqual([]);
});

test('Expression_TakenOff_IsTheLibrarysAgain', async () => {
  await model.takeOff('joy');
  expect(worn).toEqual([{ joy: null }]);
});
