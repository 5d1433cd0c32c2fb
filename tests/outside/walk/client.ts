// A client generated from /openapi.json with openapi-typescript and openapi-fetch, as a third party would do it.
import createClient, { type Middleware } from 'openapi-fetch';
import assert from 'node:assert/strict';
import type { components, paths } from '../generated/api.js';

export type Schemas = components['schemas'];
export type Client = ReturnType<typeof createClient<paths>>;

/** Receives every request and response: the AnswerCheck of ../answers.mjs. */
export interface Check {
  request(method: string, path: string, contentType: string | null, body: string): void;
  response(method: string, path: string, response: Response, body: string): void;
}

export function checkedClient(url: string, check: Check): Client {
  const client = createClient<paths>({ baseUrl: url });
  const bodies = new Map<string, string>();
  const watch: Middleware = {
    async onRequest({ request, id }) {
      if (request.body) bodies.set(id, await request.clone().text());
      return undefined;
    },
    async onResponse({ request, response, schemaPath, id }) {
      check.response(request.method, schemaPath, response, await response.clone().text());
      const body = bodies.get(id);
      if (response.ok && body) check.request(request.method, schemaPath, request.headers.get('Content-Type'), body);
      return undefined;
    },
  };
  client.use(watch);
  return client;
}

interface Answer<Data, Fault> {
  data?: Data;
  error?: Fault;
  response: Response;
}

/** The data of a response that must be successful. */
export function good<Data>(answer: Answer<Data, unknown>): NonNullable<Data> {
  assert.ok(answer.data != null, `${answer.response.url} answered ${answer.response.status}: ${JSON.stringify(answer.error)}`);
  return answer.data;
}

/** The problem document of a response that must have this error status. */
export function refused<Fault>(answer: Answer<unknown, Fault>, status: number): NonNullable<Fault> {
  assert.equal(answer.response.status, status, `${answer.response.url}: ${JSON.stringify(answer.data ?? answer.error)}`);
  assert.equal(answer.response.headers.get('Content-Type'), 'application/problem+json');
  assert.ok(answer.error != null);
  return answer.error;
}

/** Polls until the job has ended, with or without success. */
export async function ended(client: Client, id: string): Promise<Schemas['Job']> {
  const deadline = Date.now() + 120_000;
  for (;;) {
    const job = good(await client.GET('/v1/jobs/{job}', { params: { path: { job: id } } }));
    if (job.state !== 'queued' && job.state !== 'running') return job;
    assert.ok(Date.now() < deadline, `job ${id} is still ${job.stage} after two minutes`);
    await new Promise((wake) => setTimeout(wake, 50));
  }
}

/** Polls until the job has ended; the job must succeed. */
export async function finished(client: Client, id: string): Promise<Schemas['Job']> {
  const job = await ended(client, id);
  assert.equal(job.state, 'done', `${job.kind}: ${job.problem?.detail}`);
  return job;
}

/** Request options for a body that is sent unchanged with this media type. */
export const raw = (type: string) => ({
  headers: { 'Content-Type': type },
  bodySerializer: (body: unknown) => body as Uint8Array | string,
});
