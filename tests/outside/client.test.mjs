// Tests a server's /openapi.json with third-party tools, from a strict parser to a running TypeScript client.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import SwaggerParser from '@apidevtools/swagger-parser';
import { createConfig, lintFromString } from '@redocly/openapi-core';
import gltfValidator from 'gltf-validator';
import openapiTypescript, { astToString } from 'openapi-typescript';
import { AnswerCheck, parseStrictly, schemasOf, strictAjv } from './answers.mjs';
import { buildDir, startServer } from './server.mjs';

const here = fileURLToPath(new URL('.', import.meta.url));
let server;
let text;

before(async () => {
  server = await startServer();
  text = await (await fetch(`${server.url}/openapi.json`)).text();
});
after(() => server?.stop());

test('OpenApi_HasNoEqualKeys', () => {
  assert.equal(parseStrictly(text).openapi, '3.1.0');
});

test('OpenApi_PassesRedoclysRecommendedRules', async () => {
  const config = await createConfig({ extends: ['recommended'] });
  const problems = await lintFromString({ source: text, absoluteRef: `${server.url}/openapi.json`, config });
  assert.deepEqual(problems.map((each) => `${each.ruleId} ${each.location[0]?.pointer}: ${each.message}`), []);
});

test('OpenApi_IsValidForSwaggerParser', async () => {
  await SwaggerParser.validate(JSON.parse(text));
});

test('Schemas_CompileStrictly', () => {
  // All references resolve, all keywords are known, all required members are defined.
  const schemas = schemasOf(parseStrictly(text));
  const ajv = strictAjv();
  ajv.addSchema(schemas);
  for (const name of Object.keys(schemas.$defs)) ajv.compile({ $ref: `api#/$defs/${name}` });
});

test('GeneratedClient_CompilesAndWalksEveryOperation', { timeout: 300_000 }, async () => {
  // Members with a default are optional in a request; without this option the tool makes them required.
  const types = astToString(await openapiTypescript(JSON.parse(text), { defaultNonNullable: false }));
  mkdirSync(join(here, 'generated'), { recursive: true });
  writeFileSync(join(here, 'generated/api.ts'), types);
  const tsc = createRequire(import.meta.url).resolve('typescript/bin/tsc');
  try {
    execFileSync(process.execPath, [tsc, '-p', here], { encoding: 'utf8' });
  } catch (failure) {
    assert.fail(failure.stdout);
  }
  const { walk } = await import('./generated/js/walk/walk.js');
  const document = parseStrictly(text);
  const check = new AnswerCheck(document);
  const head = {
    glb: new Uint8Array(readFileSync(join(buildDir, 'sample/sample-head.glb'))),
    points: JSON.parse(readFileSync(join(buildDir, 'sample/sample-head.fps.json'), 'utf8')),
  };
  const glbs = await walk(server.url, head, check);

  const operations = Object.values(document.paths).flatMap((item) => Object.values(item).map((each) => each.operationId));
  assert.deepEqual(operations.filter((id) => !check.succeeded.has(id)), []);

  for (const [name, bytes] of Object.entries(glbs)) {
    const report = await gltfValidator.validateBytes(bytes);
    const errors = report.issues.messages.filter((message) => message.severity === 0);
    assert.deepEqual(errors, [], name);
  }
});
