import { afterEach, expect, test, vi } from 'vitest';
import { Api } from '../src/net/api.ts';

afterEach(() => void vi.unstubAllGlobals());

/** A server whose lists have one item on a page; the ids are 0 to 2. */
const serve = (member: string): string[] => {
  const asked: string[] = [];
  vi.stubGlobal('fetch', (url: string) => {
    asked.push(url);
    const id = Number(new URL(url, 'http://x').searchParams.get('after') ?? '-1') + 1;
    return Promise.resolve(Response.json({ [member]: [{ id: String(id) }], next: id < 2 ? String(id) : null }));
  });
  return asked;
};

test.each([
  ['models', (api: Api) => api.listModels()],
  ['streams', (api: Api) => api.listStreams()],
  ['recordings', (api: Api) => api.listRecordings(null)],
] as const)('lists of %s follow their pages', async (member, list) => {
  const asked = serve(member);
  expect((await list(new Api())).map((item) => item.id)).toEqual(['0', '1', '2']);
  expect(asked).toHaveLength(3);
});
