// Tests Semblante's published schemas with third-party validators, and against each other.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { parseStrictly, schemasOf, strictAjv } from './answers.mjs';
import { root } from './server.mjs';

const read = (path) => parseStrictly(readFileSync(join(root, path), 'utf8'));

const performance = read('protocol/schema/performance.schema.json');
const api = schemasOf(read('server/api/openapi.json'));
const ajv = strictAjv();
ajv.addSchema(api);
const apiSchema = (name) => ajv.compile({ $ref: `api#/$defs/${name}` });

test('PerformanceSchema_CompilesStrictly', () => {
  ajv.compile(performance);
});

test('PerformanceOfTheApi_TakesWhatItsSchemaTakes', () => {
  const bySchema = ajv.getSchema(performance.$id) ?? ajv.compile(performance);
  const byApi = apiSchema('Performance');
  const documents = [
    ...read('protocol/vectors/performance/documents.json').good,
    read('protocol/vectors/performance/corners.json'),
    read('protocol/examples/performances/hello.json'),
    read('protocol/examples/performances/minute.json'),
  ];
  for (const document of documents) {
    assert.ok(bySchema(document), JSON.stringify(document).slice(0, 300));
    assert.ok(byApi(document), ajv.errorsText(byApi.errors));
  }
});

test('PerformanceOfTheApi_HasTheMembersOfItsSchema', () => {
  const members = (schema) => Object.keys(schema.properties).sort();
  const { Performance, Cue } = api.$defs;
  const { cue } = performance.$defs;
  assert.deepEqual(members(Performance), members(performance));
  assert.deepEqual(members(Performance.properties.idle), members(performance.properties.idle));
  assert.deepEqual(members(Cue), members(cue));
  assert.deepEqual(members(Cue.properties.look_at), members(cue.properties.look_at));
  assert.deepEqual(members(Cue.properties.head), members(cue.properties.head));
});

test('RigVectors_AreAsTheApiSays', () => {
  const validate = apiSchema('Rig');
  for (const path of ['face/rig.json', 'v1/rig.json', 'v2/rig.json'])
    assert.ok(validate(read(`protocol/vectors/${path}`)), `${path}: ${ajv.errorsText(validate.errors)}`);
});
