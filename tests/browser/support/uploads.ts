import { readFileSync } from 'node:fs';
import { expect } from 'vitest';
import { samplePoints } from './paths.ts';
import { eventually } from './patience.ts';
import { server } from './suite.ts';

export async function post(path: string, type: string, body: Uint8Array<ArrayBuffer> | string, method = 'POST'): Promise<unknown> {
  const answer = await fetch(`${server.url}/v1/${path}`, { method, headers: { 'Content-Type': type }, body });
  expect(answer.status, path).toBeLessThan(300);
  return answer.json();
}

const untilModel = (id: string, wanted: string): Promise<void> =>
  eventually(`the head is ${wanted}`, async () => {
    const { state } = (await (await fetch(`${server.url}/v1/models/${id}`)).json()) as { state: string };
    return state === wanted;
  });

/** Uploads a GLB file and waits for its import; the model's id. */
export async function uploadHead(name: string, file: Uint8Array<ArrayBuffer>): Promise<string> {
  const { model } = (await post(`models?name=${name}&filename=${name}.glb`, 'model/gltf-binary', file)) as { model: { id: string } };
  await untilModel(model.id, 'ready');
  return model.id;
}

/** Of a head that has the shape of the sample head: with its points. */
export async function parametrizeAsSample(id: string): Promise<void> {
  await post(`models/${id}/feature-points`, 'application/json', readFileSync(samplePoints, 'utf8'), 'PUT');
  await post(`models/${id}/parametrizations`, 'application/json', '{"weights":"smooth"}');
  await untilModel(id, 'parametrized');
}
