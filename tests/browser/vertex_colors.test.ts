import { readFileSync } from 'node:fs';
import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { untilFace } from './support/face_page.ts';
import { sampleHead, samplePoints } from './support/paths.ts';
import { eventually } from './support/patience.ts';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

interface Gltf {
  meshes: { name: string; primitives: { material?: number; attributes: Record<string, number> }[] }[];
  accessors: { count: number }[];
  bufferViews: unknown[];
  buffers: { byteLength: number }[];
}

const padded = (bytes: Buffer, by: number): Buffer => Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4, by)]);

/** The sample head whose skin has green vertices in place of its material. */
function greenHead(): Uint8Array<ArrayBuffer> {
  const file = readFileSync(sampleHead);
  const length = file.readUInt32LE(12);
  const gltf = JSON.parse(file.toString('utf8', 20, 20 + length)) as Gltf;
  let binary = padded(file.subarray(20 + length + 8), 0);
  for (const mesh of gltf.meshes.filter(({ name }) => /^(skin|upper lids)$/.test(name))) {
    for (const primitive of mesh.primitives) {
      const { count } = gltf.accessors[primitive.attributes['POSITION']!]!;
      const colors = Buffer.concat(Array.from({ length: count }, () => Buffer.from([20, 160, 40, 255])));
      gltf.bufferViews.push({ buffer: 0, byteOffset: binary.length, byteLength: colors.length });
      gltf.accessors.push({ bufferView: gltf.bufferViews.length - 1, componentType: 5121, normalized: true, count, type: 'VEC4' } as { count: number });
      primitive.attributes['COLOR_0'] = gltf.accessors.length - 1;
      delete primitive.material;
      binary = Buffer.concat([binary, colors]);
    }
  }
  gltf.buffers[0]!.byteLength = binary.length;
  const json = padded(Buffer.from(JSON.stringify(gltf)), 0x20);
  const head = Buffer.from(file.subarray(0, 20));
  head.writeUInt32LE(28 + json.length + binary.length, 8);
  head.writeUInt32LE(json.length, 12);
  const chunk = Buffer.from(file.subarray(20 + length, 28 + length));
  chunk.writeUInt32LE(binary.length, 0);
  return Buffer.concat([head, json, chunk, binary]);
}

async function post(path: string, type: string, body: Uint8Array<ArrayBuffer> | string, method = 'POST'): Promise<unknown> {
  const answer = await fetch(`${server.url}/v1/${path}`, { method, headers: { 'Content-Type': type }, body });
  expect(answer.status, path).toBeLessThan(300);
  return answer.json();
}

const untilModel = (id: string, wanted: string): Promise<void> =>
  eventually(`the head is ${wanted}`, async () => {
    const { state } = (await (await fetch(`${server.url}/v1/models/${id}`)).json()) as { state: string };
    return state === wanted;
  });

/** Red, green and blue of a picture's middle: the face. */
const middleOf = (page: Page, picture: Buffer): Promise<number[]> =>
  page.evaluate(async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const image = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext('2d')!;
    context.drawImage(image, 0, 0);
    const { data } = context.getImageData(Math.floor(image.width / 2), Math.floor(image.height / 2), 4, 4);
    return [0, 1, 2].map((channel) => data.filter((_, i) => i % 4 === channel).reduce((sum, value) => sum + value, 0) / 16);
  }, picture.toString('base64'));

function expectGreen([red, green, blue]: number[], where: string): void {
  expect(green! - red!, where).toBeGreaterThan(40);
  expect(green! - blue!, where).toBeGreaterThan(40);
}

test('VertexColors_OfAnUploadedHead_AreShownAsPreviewAsFaceAndOnThePageOfAStream', async () => {
  const { model } = (await post('models?name=green&filename=green.glb', 'model/gltf-binary', greenHead())) as { model: { id: string } };
  await untilModel(model.id, 'ready');
  const preview = await StudioPage.open(browser, `${server.url}/#${model.id}`);
  await preview.waitForStage('ready');
  expectGreen(await middleOf(preview.page, await preview.picture()), 'the imported model');
  await preview.close();

  await post(`models/${model.id}/feature-points`, 'application/json', readFileSync(samplePoints, 'utf8'), 'PUT');
  await post(`models/${model.id}/parametrizations`, 'application/json', '{"weights":"smooth"}');
  await untilModel(model.id, 'parametrized');
  const studio = await StudioPage.open(browser, `${server.url}/#${model.id}`);
  await studio.waitForStage('ready');
  expectGreen(await middleOf(studio.page, await studio.picture()), 'the face in the studio');
  await studio.close();

  await post('streams', 'application/json', JSON.stringify({ name: 'green', model: model.id }));
  const page = await browser.newPage({ viewport: { width: 300, height: 300 } });
  await page.goto(`${server.url}/view/green`);
  await untilFace(page, 'playing', 'waiting');
  await eventually('the face is green', async () => {
    const [red, green, blue] = await middleOf(page, await page.screenshot());
    return green! - red! > 40 && green! - blue! > 40;
  });
  await page.close();
});
