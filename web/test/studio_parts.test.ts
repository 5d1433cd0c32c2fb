import { expect, test, vi } from 'vitest';
import type { Api } from '../src/net/api.ts';
import type { Model } from '../src/net/types.ts';
import { Studio } from '../src/ui/shared/studio.ts';
import type { Toasts } from '../src/ui/shared/toast.ts';

/** A model of `count` parts of which the answer has `listed`. */
const modelOf = (id: string, count: number, listed: number): Model =>
  ({
    id,
    state: 'parametrized',
    counts: { parts: count },
    parts: Array.from({ length: listed }, (_, index) => ({ index })),
  }) as unknown as Model;

const opened = async (listed: Model, whole: Model): Promise<{ studio: Studio; read: string[] }> => {
  const read: string[] = [];
  const api = {
    listModels: () => Promise.resolve([listed]),
    getModel: (id: string) => {
      read.push(id);
      return Promise.resolve(whole);
    },
  } as unknown as Api;
  const studio = new Studio(api, {} as Toasts);
  await studio.refresh();
  studio.select(listed.id);
  await vi.waitFor(() => expect(studio.selected.value).not.toBeNull());
  await Promise.resolve();
  return { studio, read };
};

test('Studio_ModelWithMorePartsThanTheList_IsRead', async () => {
  const { studio, read } = await opened(modelOf('a', 100, 32), modelOf('a', 100, 100));
  await vi.waitFor(() => expect(studio.selected.value?.parts.length).toBe(100));
  expect(read).toEqual(['a']);
});

test('Studio_ModelThatTheListHasWhole_IsNotRead', async () => {
  const { studio, read } = await opened(modelOf('a', 3, 3), modelOf('a', 3, 3));
  expect(studio.selected.value?.parts.length).toBe(3);
  expect(read).toEqual([]);
});
