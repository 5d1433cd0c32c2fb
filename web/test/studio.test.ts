import { describe, expect, test } from 'vitest';
import type { Api } from '../src/net/api.ts';
import { ApiError } from '../src/net/problem.ts';
import type { Model } from '../src/net/types.ts';
import { JobStore } from '../src/ui/shared/job_store.ts';
import { Studio } from '../src/ui/shared/studio.ts';
import type { Toasts } from '../src/ui/shared/toast.ts';
import { importingModel } from './support/models.ts';

function head(id: string, updated = '2026-01-01T00:00:00.000Z'): Model {
  return importingModel({ id, name: id, state: 'ready', updated });
}

/** A studio with these heads; `server` is what the server has, and may be changed. */
async function studioWith(...heads: Model[]): Promise<{ studio: Studio; server: { heads: Model[]; pause?: Promise<void> }; said: string[]; shown: Set<string> }> {
  const server: { heads: Model[]; pause?: Promise<void> } = { heads };
  const said: string[] = [];
  const api = {
    listModels: async () => {
      const { heads: now } = server;
      await server.pause;
      return now;
    },
    getModel: (id: string) => Promise.resolve(server.heads.find((one) => one.id === id)),
    /** Its job has ended when it is answered. */
    setFrame: (id: string) => {
      const model = importingModel({ id });
      return Promise.resolve({ model, job: { id: 'j', state: 'done', progress: 1 } });
    },
    uploadModel: (file: File) => {
      if (file.name.endsWith('.fbx') || file.name === 'large.glb') return Promise.reject(new ApiError({ type: '/problems/unsupported-media-type', title: 'no', status: 415 }));
      const model = importingModel({ id: file.name, name: file.name });
      server.heads = [...server.heads, { ...model, state: 'ready' }];
      return Promise.resolve({ model, job: { id: 'j', state: 'done', progress: 1 } });
    },
    deleteModel: (id: string) => {
      server.heads = server.heads.filter((one) => one.id !== id);
      return Promise.resolve();
    },
  } as unknown as Api;
  const shown = new Set<string>();
  const problem = (what: string): (() => void) => {
    shown.add(what);
    return () => shown.delete(what);
  };
  const studio = new Studio(api, { say: (words: string) => said.push(words), problem } as unknown as Toasts);
  await studio.start();
  studio.select(heads[0]!.id);
  return { studio, server, said, shown };
}

const ids = (studio: Studio): string[] => studio.models.value.map(({ id }) => id);

test('Update_HeadsOfOthers_ComeAndGo', async () => {
  const { studio, server, said } = await studioWith(head('ana'), head('rui'));
  server.heads = [head('eva'), head('ana')];
  await studio.update();
  expect(ids(studio)).toEqual(['eva', 'ana']);
  expect(studio.selected.value?.id).toBe('ana');
  expect(said).toEqual([]);
});

test('Update_OpenHeadDeletedElsewhere_IsSaid_AndAnotherOpens', async () => {
  const { studio, server, said } = await studioWith(head('ana'), head('rui'));
  server.heads = [head('rui')];
  await studio.update();
  expect(studio.selected.value?.id).toBe('rui');
  expect(said).toEqual(['ana was deleted elsewhere.']);
});

test('Update_OpenHeadChangedElsewhere_IsReadAgain', async () => {
  const { studio, server } = await studioWith(head('ana'));
  server.heads = [{ ...head('ana', '2026-01-02T00:00:00.000Z'), name: 'Ana Maria' }];
  await studio.update();
  await Promise.resolve();
  expect(studio.selected.value?.name).toBe('Ana Maria');
});

test('Update_OpenHeadChangedElsewhere_IsTold_UnlessThisPageWorksOnIt', async () => {
  const { studio, server, said } = await studioWith(head('ana'));
  const told: string[] = [];
  studio.onChangedElsewhere = ({ updated }) => told.push(updated);
  const parametrization = (name: string): Model['package'] => ({ parametrization: name }) as Model['package'];
  server.heads = [{ ...head('ana', '2026-01-02T00:00:00.000Z'), package: parametrization('p1') }];
  await studio.update();
  expect(told).toEqual(['2026-01-02T00:00:00.000Z']);
  expect(said).toEqual(['ana can move now.']); // its first time
  server.heads = [{ ...head('ana', '2026-01-03T00:00:00.000Z'), package: parametrization('p2') }];
  studio.activities.set(new Map([['ana', { title: 'Parametrizing', progress: null }]]));
  await studio.update();
  expect(told).toHaveLength(1);
  expect(said).toHaveLength(1);
  expect(studio.selected.value?.package?.parametrization).toBe('p2');
  studio.activities.set(new Map());
  server.heads = [{ ...head('ana', '2026-01-04T00:00:00.000Z'), package: parametrization('p3') }];
  await studio.update();
  expect(said.at(-1)).toBe('ana was parametrized elsewhere.');
});

test('Update_NothingNew_ChangesNothing', async () => {
  const { studio, server } = await studioWith(head('ana'), head('rui'));
  const before = studio.models.value;
  server.heads = [head('ana'), head('rui')];
  await studio.update();
  expect(studio.models.value).toBe(before);
});

test('Update_WhileThisPageDeletes_DoesNotBringTheHeadBack', async () => {
  const { studio, server, said } = await studioWith(head('ana'), head('rui'));
  let resume = (): void => {};
  server.pause = new Promise((resolve) => (resume = resolve));
  const updating = studio.update(); // has read both heads
  await studio.remove(studio.models.value[1]!);
  resume();
  await updating;
  expect(ids(studio)).toEqual(['ana']);
  expect(said).toEqual(['rui was deleted.']);
});

test('Import_WithWarningsOnly_GoesOnToThePoints', async () => {
  const { studio, server } = await studioWith(importingModel({ id: 'ana' }));
  server.heads = [{ ...head('ana'), findings: { errors: 0, warnings: 1, notes: 0 } }];
  studio.tab.set('live');
  await studio.update();
  await Promise.resolve();
  expect(studio.tab.value).toBe('points');
});

test('Import_WithErrors_OpensThem_ButWhoTurnsTheHeadStaysAtItsPoints', async () => {
  const warned = { ...head('ana'), findings: { errors: 1, warnings: 0, notes: 0 } };
  const { studio, server } = await studioWith(importingModel({ id: 'ana' }));
  studio.tab.set('points');
  server.heads = [warned];
  await studio.update();
  await Promise.resolve();
  expect(studio.tab.value).toBe('fit');

  studio.tab.set('points');
  await studio.setFrame(warned, { up: '+Y', front: '+Z' });
  expect(studio.selected.value?.state).toBe('ready');
  expect(studio.tab.value).toBe('points');
});

test('Upload_OfSeveralFiles_OpensTheFirst_AndShowsThoseThatWait', async () => {
  const { studio } = await studioWith(head('ana'));
  const opened: (string | undefined)[] = [];
  studio.selected.watch((model) => opened.push(model?.id));
  const shown: string[][] = [];
  studio.activities.watch((now) => {
    const titles = [...now.values()].map(({ title }) => title);
    shown.push(titles);
    if (titles[0] === 'Sending one.glb') [...now.values()].find(({ title }) => title === 'Waiting: three.glb')?.cancel?.();
  });
  await studio.upload(['one.glb', 'two.glb', 'three.glb'].map((name) => ({ path: name, file: new File(['x'], name) })));
  expect(shown).toContainEqual(['Sending one.glb', 'Waiting: two.glb', 'Waiting: three.glb']);
  expect(ids(studio)).toEqual(['two.glb', 'one.glb', 'ana']);
  expect([...new Set(opened)]).toEqual(['ana', 'one.glb']);
  expect(studio.activities.value.size).toBe(0);
});

test('Upload_ThatIsAccepted_TakesAwayTheMessagesOfFilesChosenBefore_ButNotOfThoseChosenWithIt', async () => {
  const { studio, shown } = await studioWith(head('ana'));
  const upload = (...names: string[]): Promise<void> => studio.upload(names.map((name) => ({ path: name, file: new File(['x'], name) })));
  await upload('head.fbx');
  await upload('other.fbx');
  expect([...shown]).toEqual(['head.fbx was not accepted', 'other.fbx was not accepted']);
  await upload('large.glb', 'head.glb');
  expect([...shown]).toEqual(['large.glb was not accepted']);
  await upload('next.glb');
  expect([...shown]).toEqual([]);
});

describe('Parametrization_OfAPageThatWasLoadedAgain', () => {
  /** The page's storage, and a page over it whose server has a head and what it says of the job. */
  const kept = new Map<string, string>();
  const storage = { getItem: (key: string) => kept.get(key) ?? null, setItem: (key: string, value: string) => void kept.set(key, value) } as Storage;
  async function page(getJob: () => Promise<unknown>): Promise<{ studio: Studio; said: string[]; shown: string[] }> {
    const said: string[] = [];
    const shown: string[] = [];
    const api = { listModels: () => Promise.resolve([head('ana')]), getModel: () => Promise.resolve(head('ana')), parametrize: () => Promise.resolve({ id: 'j7', state: 'running', progress: 0 }), getJob } as unknown as Api;
    const studio = new Studio(api, { say: (words: string) => said.push(words), problem: (what: string) => shown.push(what) } as unknown as Toasts, new JobStore(storage));
    await studio.start();
    return { studio, said, shown };
  }
  const never = (): Promise<never> => new Promise(() => {});
  const settled = (): Promise<void> => new Promise((wake) => setTimeout(wake));
  async function leftPage(): Promise<void> {
    const { studio } = await page(never);
    void studio.parametrize(head('ana'), {});
    await settled();
  }

  test('IsFollowedToItsEnd_AndForgotten', async () => {
    await leftPage();
    let end = (_: unknown): void => {};
    const later = await page(() => Promise.resolve({ id: 'j7', state: 'running', progress: 0.4 }));
    await settled();
    expect(later.studio.activities.value.get('ana')?.progress).toBe(0.4);
    const last = await page(() => new Promise((resolve) => (end = resolve)));
    end({ id: 'j7', state: 'done', progress: 1 });
    await settled();
    expect(last.said).toEqual(['ana can move now.']);
    expect(new JobStore(storage).read().size).toBe(0);
  });

  test('ThatFailed_IsTold', async () => {
    await leftPage();
    const { shown } = await page(() => Promise.resolve({ id: 'j7', state: 'failed', progress: 0.5 }));
    await settled();
    expect(shown).toEqual(['The head was not parametrized']);
  });

  test('ThatTheServerDoesNotKnow_IsForgotten', async () => {
    await leftPage();
    const { said, shown } = await page(() => Promise.reject(new ApiError({ type: '/problems/not-found', title: 'no', status: 404 })));
    await settled();
    expect([said, shown]).toEqual([[], []]);
    expect(new JobStore(storage).read().size).toBe(0);
  });
});
