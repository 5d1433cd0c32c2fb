// Walks from an uploaded head to its face package and displacement sets.
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { type Client, type Schemas, finished, good, raw, refused } from './client.js';

export interface Head {
  glb: Uint8Array;
  points: Schemas['FeaturePointsBody'];
}

/** glTF files received during the walk, for validation by other tools. */
export interface Glbs {
  [name: string]: Uint8Array;
}

async function upload(client: Client, head: Head): Promise<Schemas['Model']> {
  const made = good(
    await client.POST('/v1/models', {
      params: { query: { name: 'Ana', filename: 'ana.glb' } },
      ...raw('model/gltf-binary'),
      body: head.glb,
    }),
  );
  assert.equal(made.model.frame, null, 'before the import');
  assert.equal((await finished(client, made.job.id)).result, null);
  const events: string = good(
    await client.GET('/v1/jobs/{job}/events', { params: { path: { job: made.job.id } }, parseAs: 'text' }),
  );
  assert.match(events, /^event: done$/m);
  refused(await client.DELETE('/v1/jobs/{job}', { params: { path: { job: made.job.id } } }), 409);
  return good(await client.GET('/v1/models/{model}', { params: { path: { model: made.model.id } } }));
}

/** Type check of a model's `frame`: the declared types below match the generated ones, or this does not compile. */
function readFrame(model: Schemas['Model']): void {
  const frame: Schemas['ModelFrame'] | null = model.frame;
  assert.ok(frame);
  const unit: 'm' | 'dm' | 'cm' | 'mm' | 'in' = frame.unit;
  const metres: number = frame.metres_per_unit;
  const up: '+X' | '-X' | '+Y' | '-Y' | '+Z' | '-Z' = frame.axes.up;
  const sure: boolean = frame.sure.axes;
  const reasons: string[] = frame.reasons;
  assert.deepEqual([unit, metres, up, sure], ['m', 1, '+Y', true]);
  assert.ok(reasons.length > 0);
}

async function mark(client: Client, model: string, head: Head): Promise<void> {
  const path = { model };
  const quick = ['9.3', '9.15', '8.1', '2.2', '2.3', '8.2', '2.1', '11.4', '3.11', '3.7', '3.1', '3.3', '3.12', '4.1'];
  const some = Object.fromEntries(Object.entries(head.points.points).filter(([id]) => quick.includes(id)));
  const put = (points: Schemas['FeaturePointsBody']) =>
    client.PUT('/v1/models/{model}/feature-points', { params: { path }, body: points });
  const bad = refused(await put({ points: { '2.1': { vertex: 999_999_999 }, '99.1': { vertex: 1 } } }), 422);
  assert.deepEqual([bad.type, bad.pointer, bad.advice], ['/problems/invalid-feature-point', '/points/2.1/vertex', 'move-points']);
  assert.deepEqual(bad.errors?.map((each) => each.pointer), ['/points/2.1/vertex', '/points/99.1']);
  good(await put({ points: some }));

  const job = good(await client.POST('/v1/models/{model}/feature-points/proposals', { params: { path }, body: {} }));
  const result = (await finished(client, job.id)).result;
  assert.ok(result && 'proposed' in result && result.proposed > 0);
  const proposed = good(await client.GET('/v1/models/{model}/feature-points', { params: { path } }));
  assert.ok(Object.values(proposed.points).some((point) => point.proposed && point.confidence));

  // What a finding's `move` asks for: one point to another place, the others stay.
  const edit = { points: { '8.1': head.points.points['8.1']!, '2.2': null } };
  const edited = good(await client.PATCH('/v1/models/{model}/feature-points', { params: { path }, body: edit }));
  assert.deepEqual([edited.points['2.2'], '2.3' in edited.points], [undefined, true]);
  const odd = { points: {}, frames: [] } as Schemas['FeaturePointsEdit'];
  refused(await client.PATCH('/v1/models/{model}/feature-points', { params: { path }, body: odd }), 422);

  const stored = good(await put(head.points));
  assert.equal(Object.keys(stored.points).length, 84);
}

async function fetchPackage(client: Client, model: Schemas['Model'], glbs: Glbs): Promise<void> {
  const params = { path: { model: model.id } };
  const artefacts = model.package?.artefacts ?? {};
  const expect = (name: string, bytes: ArrayBuffer | Uint8Array): Uint8Array => {
    const view = new Uint8Array(bytes);
    assert.equal(view.byteLength, artefacts[name]?.bytes, name);
    assert.equal(createHash('sha256').update(view).digest('hex'), artefacts[name]?.sha256, name);
    return view;
  };
  const parseAs = 'arrayBuffer';
  expect('mesh.drc', good(await client.GET('/v1/models/{model}/mesh.drc', { params, parseAs })));
  expect('weights', good(await client.GET('/v1/models/{model}/weights', { params, parseAs })));
  glbs['face.glb'] = expect('face.glb', good(await client.GET('/v1/models/{model}/face.glb', { params, parseAs })));
  glbs['preview.glb'] = new Uint8Array(good(await client.GET('/v1/models/{model}/preview.glb', { params, parseAs })));
  const smile = { format: 'semblante.performance' as const, version: 1 as const, cues: [{ time: 0, duration: 200, expression: 'joy' as const }] };
  glbs['clip.glb'] = new Uint8Array(good(await client.POST('/v1/models/{model}/clip', { params, body: smile, parseAs })));
  const rig = good(await client.GET('/v1/models/{model}/rig.json', { params }));
  assert.equal(rig.mesh.sha256, artefacts['mesh.drc']?.sha256);
  assert.equal(rig.visemes[10]?.name, 'a');

  const level = model.package?.levels[1];
  assert.ok(level, 'a level of detail was asked for');
  const small = { ...params, query: { lod: 1 } };
  assert.equal(good(await client.GET('/v1/models/{model}/rig.json', { params: small })).mesh.vertices, level.vertices);
  const report = good(await client.GET('/v1/models/{model}/report.json', { params }));
  assert.deepEqual(report.frame, model.frame);
  assert.equal(report.levels_of_detail?.levels[0]?.vertices, level.vertices);

  const sha256 = artefacts['weights']?.sha256 ?? '';
  const part = await client.GET('/v1/artefacts/{sha256}', {
    params: { path: { sha256 }, header: { Range: 'bytes=0-3' } },
    parseAs,
  });
  assert.equal(part.response.status, 206);
  expect('weights', good(await client.GET('/v1/artefacts/{sha256}', { params: { path: { sha256 } }, parseAs })));
}

/** A flat sheet as an OBJ file; `lift` raises the vertex at the left corner of the mouth. */
function sheet(lift: number): Uint8Array {
  const side = 9;
  const lines: string[] = [];
  for (let i = 0; i < side * side; i += 1)
    lines.push(`v ${(i % side) - 4} ${Math.floor(i / side) + (i === 38 ? lift : 0)} 0`);
  for (let i = 0; i + side + 1 < side * side; i += 1)
    if (i % side < side - 1) lines.push(`f ${i + 1} ${i + 2} ${i + side + 2} ${i + side + 1}`);
  return new TextEncoder().encode(`${lines.join('\n')}\n`);
}

/** Cancels a job; if the job ends before the cancellation, starts another one. */
async function cancelOne(client: Client, model: string): Promise<void> {
  for (let left = 10; left > 0; left -= 1) {
    const job = good(await client.POST('/v1/models/{model}/parametrizations', { params: { path: { model } } }));
    const answer = await client.DELETE('/v1/jobs/{job}', { params: { path: { job: job.id } } });
    if (answer.data) return;
    refused(answer, 409);
  }
  assert.fail('ten jobs ended before they could be cancelled');
}

async function makeSets(client: Client, model: string): Promise<void> {
  const listed = good(await client.GET('/v1/expressions'));
  assert.deepEqual([listed.visemes[0], listed.expressions[1], listed.sets.length], ['sil', 'joy', 0]);
  const grin: Schemas['ExpressionEdit'] = { name: 'Grin', kind: 'expression', displacements: { '2.4': [100, 50, 0] } };
  const made = good(await client.POST('/v1/expressions', { body: grin }));
  assert.ok('revision' in made);
  const path = { expression: made.id };
  const on = good(await client.GET('/v1/expressions/{expression}', { params: { path, query: { model } } }));
  assert.equal(on.on_model?.displacements['2.4']?.length, 3);
  good(await client.GET('/v1/expressions/{expression}', { params: { path: { expression: 'joy' } } }));
  const wide = { ...grin, name: 'Wide grin' };
  const put = (header: { 'If-Match'?: string }) =>
    client.PUT('/v1/expressions/{expression}', { params: { path, header }, body: wide });
  assert.equal(good(await put({})).revision, 2);
  refused(await put({ 'If-Match': '"set-1"' }), 412);

  const form = new FormData();
  form.set('options', JSON.stringify({ name: 'Lifted', least: 0 }));
  form.set('neutral', new Blob([sheet(0)]), 'neutral.obj');
  form.set('expression', new Blob([sheet(0.5)]), 'lifted.obj');
  const points = { '2.1': 4, '2.2': 40, '2.3': 31, '2.4': 38, '2.5': 42, '8.3': 38, '8.4': 42, '9.15': 58 };
  const marked = Object.fromEntries(Object.entries(points).map(([id, vertex]) => [id, { vertex }]));
  form.set('feature_points', JSON.stringify({ points: marked }));
  const job = good(await client.POST('/v1/expressions', { body: { expression: '' }, bodySerializer: () => form }));
  assert.ok('state' in job);
  const result = (await finished(client, job.id)).result;
  assert.ok(result && 'expression' in result && result.points > 0);
  const taken = { path: { expression: result.expression } };
  const set = good(await client.GET('/v1/expressions/{expression}', { params: taken }));
  assert.equal(set.source?.expression_file, 'lifted.obj');
  assert.equal(good(await client.GET('/v1/expressions')).sets.length, 2);

  const wish = { expressions: { joy: made.id } };
  const worn = await client.PATCH('/v1/models/{model}', { params: { path: { model } }, body: wish });
  assert.equal(good(worn).expressions['joy']?.name, 'Wide grin');
  assert.equal(worn.response.status, 202, 'the package is made again');
  await cancelOne(client, model);
  await finished(client, (worn.response.headers.get('Location') ?? '').replace('/v1/jobs/', ''));
  for (const expression of [made.id, set.id]) {
    const gone = await client.DELETE('/v1/expressions/{expression}', { params: { path: { expression } } });
    assert.equal(gone.response.status, 204);
  }
}

/** Creates a parametrized model and returns its id. */
export async function walkFace(client: Client, head: Head, glbs: Glbs): Promise<string> {
  const model = await upload(client, head);
  const params = { path: { model: model.id } };
  readFrame(model);
  await mark(client, model.id, head);
  const job = good(
    await client.POST('/v1/models/{model}/parametrizations', { params, body: { metric: 'edge', lods: [2000] } }),
  );
  await finished(client, job.id);
  const ready = good(await client.GET('/v1/models/{model}', { params }));
  assert.equal(ready.state, 'parametrized');
  await fetchPackage(client, ready, glbs);
  await makeSets(client, model.id);
  const edit: Schemas['ModelEdit'] = { name: 'Bea', roles: { '0': null }, frame: { unit: 'm' } };
  assert.equal(good(await client.PATCH('/v1/models/{model}', { params, body: edit })).name, 'Bea');
  assert.deepEqual(good(await client.GET('/v1/models')).models.map((each) => each.name), ['Bea']);
  return model.id;
}
