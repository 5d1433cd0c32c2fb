import { afterEach, beforeEach, describe, expect, test, vi } from 'vitest';
import type { Model } from '../src/net/types.ts';
import { mostOfAll, mostOfOne, Portraits, smallestOf, type PortraitSources } from '../src/ui/heads/portraits.ts';
import type { Shelf } from '../src/ui/heads/shelf.ts';
import { Signal } from '../src/ui/shared/signal.ts';
import type { Studio } from '../src/ui/shared/studio.ts';
import type { SceneView } from '../src/ui/stage/scene.ts';
import { importingModel } from './support/models.ts';

const artefacts = (bytes: number) => Object.fromEntries(['mesh.drc', 'weights', 'rig.json'].map((name) => [name, { bytes }]));
const faceOf = (...sizes: number[]): Model['package'] =>
  ({ parametrization: 'p', artefacts: artefacts(sizes[0]!), levels: sizes.map((bytes, lod) => ({ lod, artefacts: artefacts(bytes) })) }) as unknown as Model['package'];
const head = (id: string, over: Partial<Model> = {}): Model => importingModel({ id, state: 'parametrized', package: faceOf(9000, 1000), ...over });

test('SmallestOf_AFaceWithLevels_IsTheSmallestLevel_AndOfAHeadWithoutFaceTheStillModel', () => {
  expect(smallestOf(head('a'))).toEqual({ level: 1, bytes: 3000 });
  expect(smallestOf(head('a', { package: { ...faceOf(500)!, levels: [] } }))).toEqual({ level: 0, bytes: 1500 });
  const still = head('a', { state: 'ready', package: null });
  expect(smallestOf(still)).toEqual({ level: null, bytes: still.source.bytes });
  for (const state of ['importing', 'failed'] as const) expect(smallestOf(head('a', { state, package: null }))).toBeNull();
});

describe('portraits', () => {
  const listeners: (() => void)[] = [];
  let hook: (() => boolean) | null = null;

  beforeEach(() => {
    vi.useFakeTimers();
    vi.stubGlobal('window', globalThis);
    vi.stubGlobal('navigator', {});
    vi.stubGlobal('document', { hidden: false, addEventListener: (_: string, act: () => void) => listeners.push(act) });
  });
  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  /** What is loaded and shown within a minute, of these heads in the list. */
  async function run(models: Model[], seen: () => Model[], sources: Partial<PortraitSources> = {}): Promise<{ loaded: string[]; shown: string[] }> {
    const loaded: string[] = [];
    const shown: string[] = [];
    const thumbnails = new Map<string, string>();
    const scene = {
      state: new Signal({ kind: 'ready' }),
      stage: { onFrame: (act: () => boolean) => (hook = act) },
      portraitOf: (model: Model) => Promise.resolve(() => `picture of ${model.id}`),
    };
    const studio = { models: new Signal(models), tab: new Signal('heads'), selected: new Signal({ id: 'open' }) };
    const shelf = { thumbnails, seen };
    const all: PortraitSources = {
      preview: (id) => (loaded.push(`${id} still`), Promise.resolve({ bytes: new Uint8Array(5), read: 5 })),
      face: (id, level) => (loaded.push(`${id} ${level}`), Promise.resolve({ still: {} as never, imageBytes: 0 })),
      ...sources,
    };
    new Portraits(studio as unknown as Studio, scene as unknown as SceneView, shelf as unknown as Shelf, all, (id, picture) => {
      thumbnails.set(id, picture);
      shown.push(id);
    }).begin();
    for (let i = 0; i < 600; i += 1) {
      await vi.advanceTimersByTimeAsync(100);
      hook?.();
    }
    return { loaded, shown };
  }

  test('Portraits_OfHeadsThatAreSeen_AreDrawnEachOnceFromTheSmallestModel', async () => {
    const models = [head('a'), head('b', { state: 'ready', package: null }), head('open'), head('c')];
    expect(await run(models, () => models.slice(0, 3))).toEqual({ loaded: ['a 1', 'b still'], shown: ['a', 'b'] });
  });

  test('Portraits_OfLargeHeads_AreNotLoaded', async () => {
    const models = [head('large', { package: faceOf(mostOfOne) }), head('small')];
    expect((await run(models, () => models)).loaded).toEqual(['small 1']);
  });

  test('Portraits_OfAThousandHeads_LoadNoMoreThanAPageMay', async () => {
    const each = mostOfOne / 4;
    const models = Array.from({ length: 1000 }, (_, i) => head(`h${i}`, { package: faceOf(each) }));
    expect((await run(models, () => models)).loaded.length).toBeLessThanOrEqual(mostOfAll / (3 * each));
  });

  test('Portraits_ThatCannotBeLoaded_AreNotAskedForAgain', async () => {
    let tries = 0;
    const models = [head('a')];
    const preview = (): Promise<never> => Promise.reject(new Error(`no answer ${(tries += 1)}`));
    expect(await run(models, () => models, { face: preview })).toEqual({ loaded: [], shown: [] });
    expect(tries).toBe(1);
  });

  test('Portraits_InAPageThatIsNotSeen_OrSavesData_AreNotLoaded', async () => {
    const models = [head('a')];
    vi.stubGlobal('document', { hidden: true, addEventListener: () => undefined });
    expect((await run(models, () => models)).loaded).toEqual([]);
    vi.stubGlobal('document', { hidden: false, addEventListener: () => undefined });
    vi.stubGlobal('navigator', { connection: { saveData: true } });
    expect((await run(models, () => models)).loaded).toEqual([]);
  });
});
