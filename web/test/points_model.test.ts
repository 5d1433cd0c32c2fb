import { expect, test, vi } from 'vitest';
import type { PlacedPoint } from '../src/face/point_draft.ts';
import type { Api } from '../src/net/api.ts';
import { ApiError } from '../src/net/problem.ts';
import type { FeaturePointsBody, FeaturePointSet, Model } from '../src/net/types.ts';
import { DraftStore } from '../src/ui/points/draft_store.ts';
import { MirrorLock } from '../src/ui/points/mirror_lock.ts';
import { PointsModel } from '../src/ui/points/points_model.ts';
import { SettingsStore } from '../src/ui/points/settings_store.ts';
import { Studio } from '../src/ui/shared/studio.ts';
import type { ToastAction, Toasts } from '../src/ui/shared/toast.ts';
import { memory } from './support/memory.ts';
import { importingModel } from './support/models.ts';

const ana: Model = importingModel({ id: 'ana', name: 'Ana', state: 'ready' });
const at = (vertex: number): PlacedPoint => ({ vertex, position: [vertex, 0, 0] });

/** The points of one head on a server that several persons write to. */
class Server {
  revision = 1;
  points: Record<string, PlacedPoint> = { '2.1': at(1), '3.1': at(2) };
  fapu: FeaturePointSet['fapu'] = {};

  /** Another person saves. */
  write(points: Record<string, PlacedPoint>): void {
    this.points = { ...this.points, ...points };
    this.revision += 1;
  }

  answer = (): { value: FeaturePointSet; etag: string; location: null } => ({
    value: { points: this.points, fapu: this.fapu } as unknown as FeaturePointSet,
    etag: `points-${this.revision}`,
    location: null,
  });

  readonly api = {
    getFeaturePoints: () => Promise.resolve(this.answer()),
    getModel: () => Promise.resolve(ana),
    putFeaturePoints: (_: string, body: FeaturePointsBody, { etag }: { etag: string }) => {
      if (etag !== `points-${this.revision}`) 
        return Promise.reject(new ApiError({ type: '/problems/precondition-failed', title: 'changed', status: 412 }));
      this.points = body.points as unknown as Record<string, PlacedPoint>;
      this.revision += 1;
      return Promise.resolve(this.answer());
    },
  };
}

/** The page of one person who has opened the head. */
async function open(server: Server, storage = memory()): Promise<{ points: PointsModel; said: string[]; problems: string[]; actions: ToastAction[] }> {
  const said: string[] = [];
  const problems: string[] = [];
  const actions: ToastAction[] = [];
  const problem = (words: string, _: unknown, action?: ToastAction): void => {
    problems.push(words);
    if (action) actions.push(action);
  };
  const toasts = { say: (words: string) => said.push(words), problem } as unknown as Toasts;
  const studio = new Studio(server.api as unknown as Api, toasts);
  const points = new PointsModel(studio, new DraftStore(storage), new MirrorLock(studio, new SettingsStore(memory())));
  await points.open(ana);
  return { points, said, problems, actions };
}

const vertices = (points: Iterable<[string, PlacedPoint]>): object => Object.fromEntries([...points].map(([id, { vertex }]) => [id, vertex]));

function move(points: PointsModel, id: string, vertex: number): void {
  points.move(id, at(vertex));
}

test('Points_SavedByAnother_AreShown', async () => {
  const server = new Server();
  const { points, said } = await open(server);
  server.write({ '2.1': at(10), '8.3': at(30) });
  await points.update(ana);
  expect(vertices(points.draft.points)).toEqual({ '2.1': 10, '3.1': 2, '8.3': 30 });
  expect(points.draft.changes).toBe(0);
  expect(said).toEqual(['Someone else changed 2 points.']);
  await points.update(ana); // nothing new
  expect(said).toHaveLength(1);
});

test('Points_SavedByAnother_BesideADraft_AreShownAndTheDraftStays', async () => {
  const server = new Server();
  const { points, said } = await open(server);
  move(points, '3.1', 20);
  server.write({ '2.1': at(10) });
  await points.update(ana);
  expect(vertices(points.draft.points)).toEqual({ '2.1': 10, '3.1': 20 });
  expect(points.contested).toEqual([]);
  expect(said).toEqual(['Someone else changed 1 point. Your unsaved changes are kept.']);
  expect(await points.save()).toBe(true);
  expect(vertices(Object.entries(server.points))).toEqual({ '2.1': 10, '3.1': 20 });
});

test('Points_BothSaveWithinTheUpdate_BothAreKept', async () => {
  const server = new Server();
  const { points, problems } = await open(server);
  move(points, '3.1', 20);
  server.write({ '2.1': at(10) });
  expect(await points.save()).toBe(true);
  expect(vertices(Object.entries(server.points))).toEqual({ '2.1': 10, '3.1': 20 });
  expect(problems).toEqual([]);
});

test('Points_SavedWithoutHearingTheAnswer_AreNobodyElses', async () => {
  const server = new Server();
  const { points, said, problems } = await open(server);
  move(points, '2.1', 10);
  server.write({ '2.1': at(10) }); // this page's own request, whose answer was lost
  expect(await points.save()).toBe(true);
  expect(points.draft.changes).toBe(0);
  expect([...said, ...problems]).toEqual([]);
});

test.each([true, false])('Points_OnePointChangedByBoth_IsAChoice (theirs: %s)', async (theirs) => {
  const server = new Server();
  const { points, said, problems } = await open(server);
  move(points, '2.1', 20);
  server.write({ '2.1': at(10) });
  expect(await points.save()).toBe(false);
  expect(vertices(Object.entries(server.points))).toEqual({ '2.1': 10, '3.1': 2 });
  expect(points.contested).toEqual(['2.1']);
  expect(said).toEqual(['Someone else changed points that you have changed too.']);
  expect(problems).toEqual(['The feature points were not saved']);
  expect(points.draft.points.get('2.1')?.vertex).toBe(20);
  points.settle(theirs);
  expect(points.contested).toEqual([]);
  expect(points.draft.points.get('2.1')?.vertex).toBe(theirs ? 10 : 20);
  if (theirs) points.undo();
  expect(await points.save()).toBe(true);
  expect(vertices(Object.entries(server.points))).toEqual({ '2.1': 20, '3.1': 2 });
});

test.each([true, false])('Points_OfADraftThatComesBack_ChangedElsewhereMeanwhile_AreAChoice (theirs: %s)', async (theirs) => {
  const server = new Server();
  const storage = memory();
  const before = await open(server, storage);
  move(before.points, '2.1', 20);
  move(before.points, '3.1', 40);
  server.write({ '2.1': at(10) });
  const { points, said } = await open(server, storage);
  expect(points.contested).toEqual(['2.1']);
  expect(said).toEqual(['Someone else changed points that you have changed too.']);
  expect(vertices(points.draft.points)).toEqual({ '2.1': 20, '3.1': 40 });
  const again = await open(server, storage); // undecided: it stays a choice
  expect(again.points.contested).toEqual(['2.1']);
  again.points.settle(theirs);
  expect(again.points.contested).toEqual([]);
  expect(vertices(again.points.draft.points)).toEqual({ '2.1': theirs ? 10 : 20, '3.1': 40 });
  const decided = await open(server, storage);
  expect(decided.points.contested).toEqual([]);
  expect(decided.said).toEqual([theirs ? 'Your unsaved point is back.' : 'Your 2 unsaved points are back.']);
});

test('Units_SetByAnother_AreTakenAndSaid', async () => {
  const server = new Server();
  const { points, said } = await open(server);
  server.fapu = { ES0: 0.06 } as FeaturePointSet['fapu'];
  server.write({});
  await points.update(ana);
  expect(points.fapu).toEqual({ ES0: 0.06 });
  expect(said).toEqual(['Someone else changed the units of the face.']);
});

test('Points_OfAHeadTurnedByAnother_AreReadAgain', async () => {
  const server = new Server();
  const { points } = await open(server);
  move(points, '2.1', 20);
  server.write({ '2.1': at(10) });
  await points.update({ ...ana, frame: { axes: { up: '+Z', front: '-Y' } } as Model['frame'] });
  expect(points.draft.points.get('2.1')?.vertex).toBe(10);
  expect(points.draft.canUndo).toBe(false);
});

test('File_ChosenWhileItsHeadIsRead_IsTakenWhenItHasBeenRead', async () => {
  const server = new Server();
  server.points = {};
  const { points, said, problems } = await open(server);
  await points.open(importingModel({ id: 'ana', name: 'Ana' }));
  await points.importFile(new File([JSON.stringify({ points: { '2.1': at(5) } })], 'ana.fps.json'));
  expect(server.points).toEqual({});
  expect(said).toEqual(['ana.fps.json is taken when the head has been read.']);
  await points.open(ana);
  expect(vertices(points.draft.points)).toEqual({ '2.1': 5 });
  expect(vertices(new Map(Object.entries(server.points)))).toEqual({ '2.1': 5 });
  expect(problems).toEqual([]);
});

test('File_WithRefusedPoints_IsSaidAndTheOthersCanBeTaken', async () => {
  const server = new Server();
  const { points, said, problems, actions } = await open(server);
  const { putFeaturePoints } = server.api;
  server.api.putFeaturePoints = (id, body, options) =>
    '3.5' in body.points
      ? Promise.reject(new ApiError({ type: '/problems/invalid-feature-point', title: 'impossible', status: 422, errors: [{ pointer: '/points/3.5/vertex', detail: 'vertex 473 is not there' }] }))
      : putFeaturePoints(id, body, options);
  const file = new File([JSON.stringify({ points: { '2.1': at(5), '3.5': at(473), '8.3': at(6) } })], 'ana.fps.json');
  expect(await points.importFile(file)).toBe(false);
  expect(problems).toEqual(['The points of ana.fps.json were not accepted']);
  expect(points.problemsOfFile).toBe(true);
  expect(vertices(points.draft.points)).toEqual({ '2.1': 1, '3.1': 2 });
  expect(actions.map(({ label }) => label)).toEqual(['Take the other 2']);
  actions[0]!.act();
  await vi.waitFor(() => expect(vertices(points.draft.points)).toEqual({ '2.1': 5, '8.3': 6 }));
  await vi.waitFor(() => expect(said).toEqual(['2 feature points read from ana.fps.json.']));
  expect(points.problems.size).toBe(0);
});
