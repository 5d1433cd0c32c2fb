// Walks through the server's own resources and its error responses.
import assert from 'node:assert/strict';
import { type Client, ended, good, raw, refused } from './client.js';

export async function walkSystem(client: Client): Promise<void> {
  assert.equal(good(await client.GET('/healthz')).status, 'ok');
  assert.equal(good(await client.GET('/readyz')).status, 'ok');
  assert.equal(good(await client.GET('/version')).name, 'semblante');
  good(await client.GET('/openapi.json'));
  const specification: string = good(await client.GET('/v1/protocol/SPEC.md', { parseAs: 'text' }));
  assert.match(specification, /^# Semblante protocol, version 1$/m);
  assert.equal(good(await client.GET('/v1/protocol/packed_tables.json')).references.length, 69);
  const metrics: string = good(await client.GET('/metrics', { parseAs: 'text' }));
  assert.match(metrics, /^# TYPE \S+ (counter|gauge|histogram)$/m);

  const session = good(await client.GET('/v1/session'));
  assert.deepEqual([session.asks_for_tokens, session.scope], [false, 'admin']);
  const made = good(await client.POST('/v1/tokens', { body: { name: 'walk', scope: 'read', expires_in: 60 } }));
  const tokens = good(await client.GET('/v1/tokens')).tokens;
  assert.deepEqual(tokens.map(({ id }) => id), [made.token.id]);
  assert.equal(good(await client.POST('/v1/session', { body: { token: made.secret } })).scope, 'admin');
  assert.equal((await client.DELETE('/v1/session')).response.status, 204);
  const usage = good(await client.GET('/v1/usage'));
  assert.ok(usage.limits.some((limit) => limit.name === 'bytes' && limit.limit === null));
  assert.ok(good(await client.POST('/v1/tickets', { body: { path: '/v1/models' } })).ticket.length > 40);
  const params = { path: { token: made.token.id } };
  assert.equal((await client.DELETE('/v1/tokens/{token}', { params })).response.status, 204);

  const absent = refused(await client.GET('/v1/models/{model}', { params: { path: { model: 'nobody' } } }), 404);
  const slug = absent.type.slice('/problems/'.length);
  const kind = good(await client.GET('/problems/{slug}', { params: { path: { slug } } }));
  assert.deepEqual([kind.type, kind.title, kind.status], [absent.type, absent.title, 404]);

  const limit = refused(await client.GET('/v1/models', { params: { query: { limit: 0 } } }), 400);
  assert.equal(limit.pointer, '?limit');
  const html = { ...raw('text/html'), bodySerializer: () => '<p>' };
  refused(await client.POST('/v1/streams', { ...html, body: { name: 'x' } }), 415);
  const noModel = new Uint8Array(100).fill(1);
  refused(await client.POST('/v1/models', { ...raw('application/octet-stream'), body: noModel }), 415);
}

/** Imports an unreadable model: job and model both keep the problem document. */
export async function walkFailedImport(client: Client): Promise<void> {
  const body = 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n';
  const made = good(await client.POST('/v1/models', { ...raw('model/obj'), body }));
  const job = await ended(client, made.job.id);
  assert.deepEqual([job.state, job.problem?.type, job.problem?.advice], ['failed', '/problems/malformed-model', 'export-again']);
  const params = { path: { model: made.model.id } };
  const model = good(await client.GET('/v1/models/{model}', { params }));
  assert.deepEqual([model.state, model.bounds, model.problem], ['failed', null, job.problem]);
  refused(await client.PUT('/v1/models/{model}/feature-points', { params, body: { points: {} } }), 409);
  assert.equal((await client.DELETE('/v1/models/{model}', { params })).response.status, 204);
}
