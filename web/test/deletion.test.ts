import { afterEach, expect, test, vi } from 'vitest';
import { Api } from '../src/net/api.ts';

const answerWith = (status: number): void =>
  void vi.stubGlobal('fetch', () => Promise.resolve(new Response(JSON.stringify({ type: '/problems/x', title: 'x', status }), { status, headers: { 'Content-Type': 'application/problem+json' } })));
afterEach(() => vi.unstubAllGlobals());

test('Deletion_OfWhatAnotherPageHasDeleted_IsDone', async () => {
  answerWith(404);
  await expect(new Api('').deleteModel('ana')).resolves.toBeUndefined();
  await expect(new Api('').deleteStream('demo')).resolves.toBeUndefined();
});

test('Deletion_ThatIsRefused_IsAnError', async () => {
  answerWith(403);
  await expect(new Api('').deleteModel('ana')).rejects.toThrow();
});
