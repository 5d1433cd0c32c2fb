// Calls all operations of the document with the generated client on a real server.
import assert from 'node:assert/strict';
import { type Check, checkedClient, refused } from './client.js';
import { type Glbs, type Head, walkFace } from './face.js';
import { walkLive } from './live.js';
import { walkFailedImport, walkSystem } from './system.js';

/** Returns the received glTF files. Throws at the first deviation from the document. */
export async function walk(url: string, head: Head, check: Check): Promise<Glbs> {
  const client = checkedClient(url, check);
  const glbs: Glbs = {};
  await walkSystem(client);
  await walkFailedImport(client);
  const model = await walkFace(client, head, glbs);
  await walkLive(client, model, glbs);
  const params = { path: { model } };
  assert.equal((await client.DELETE('/v1/models/{model}', { params })).response.status, 204);
  refused(await client.GET('/v1/models/{model}', { params }), 404);
  return glbs;
}
