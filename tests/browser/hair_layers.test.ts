import type { Page } from 'playwright-core';
import { expect, test } from 'vitest';
import { EditedGlb } from './support/edit_glb.ts';
import { untilFace } from './support/face_page.ts';
import { sampleHead } from './support/paths.ts';
import { eventually } from './support/patience.ts';
import { isGreen, middleOf } from './support/pixels.ts';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';
import { parametrizeAsSample, post, uploadHead } from './support/uploads.ts';

useStudio({ demo: false });

async function nearestIsSeen(page: Page, picture: Buffer): Promise<boolean> {
  return isGreen(await middleOf(page, picture, 0.1)) && isGreen(await middleOf(page, picture, -0.1));
}

/** PNG: a green half and a red half, with a transparent border, without which nothing would be blended. */
async function twoColors(): Promise<Uint8Array> {
  const page = await browser.newPage();
  const base64 = await page.evaluate(() => {
    const canvas = document.createElement('canvas');
    canvas.width = canvas.height = 64;
    const context = canvas.getContext('2d')!;
    context.fillStyle = 'rgb(20 160 40)';
    context.fillRect(4, 4, 28, 56);
    context.fillStyle = 'rgb(200 20 20)';
    context.fillRect(32, 4, 28, 56);
    return canvas.toDataURL('image/png').split(',')[1]!;
  });
  await page.close();
  return Buffer.from(base64, 'base64');
}

/**
 * The sample head with two layers of hair before its face, of which the green one is nearer: in the lower half the file
 * has it first, in the upper half last.
 */
async function headBehindHair(): Promise<Uint8Array<ArrayBuffer>> {
  const head = new EditedGlb(sampleHead);
  const { gltf } = head;
  gltf.images!.push({ bufferView: head.addBytes(await twoColors()), mimeType: 'image/png' });
  gltf.textures!.push({ source: gltf.images!.length - 1 });
  const baseColorTexture = { index: gltf.textures!.length - 1 };
  gltf.materials.push({ name: 'strands of hair', alphaMode: 'BLEND', pbrMetallicRoughness: { baseColorTexture, metallicFactor: 0 } });
  const positions: number[] = [];
  const uvs: number[] = [];
  const near = { z: 0.17, u: 0.3 };
  const far = { z: 0.15, u: 0.7 };
  for (const [bottom, order] of [[-0.1, [near, far]], [0, [far, near]]] as const) {
    for (const { z, u } of order) {
      positions.push(-0.12, bottom, z, 0.12, bottom, z, 0.12, bottom + 0.1, z, -0.12, bottom + 0.1, z);
      uvs.push(u, 0.5, u, 0.5, u, 0.5, u, 0.5);
    }
  }
  const indices = [0, 4, 8, 12].flatMap((first) => [0, 1, 2, 0, 2, 3].map((corner) => first + corner));
  gltf.meshes.push({
    name: 'strands of hair',
    primitives: [{
      material: gltf.materials.length - 1,
      indices: head.addAccessor(Uint16Array.from(indices), 'SCALAR', 24),
      attributes: {
        POSITION: head.addAccessor(Float32Array.from(positions), 'VEC3', 16, { min: [-0.12, -0.1, 0.15], max: [0.12, 0.1, 0.17] }),
        TEXCOORD_0: head.addAccessor(Float32Array.from(uvs), 'VEC2', 16),
      },
    }],
  });
  gltf.nodes.push({ mesh: gltf.meshes.length - 1, name: 'strands of hair' });
  gltf.scenes[0]!.nodes.push(gltf.nodes.length - 1);
  return head.bytes();
}

test('LayersOfHair_InAnyOrder_TheNearestIsSeen_AsPreviewAsFaceAndOnThePageOfAStream', async () => {
  const id = await uploadHead('layers', await headBehindHair());
  const preview = await StudioPage.open(browser, `${server.url}/#${id}`);
  await preview.waitForStage('ready');
  expect(await nearestIsSeen(preview.page, await preview.picture()), 'in the imported model').toBe(true);
  await preview.close();

  await parametrizeAsSample(id);
  const studio = await StudioPage.open(browser, `${server.url}/#${id}`);
  await studio.waitForStage('ready');
  expect(await nearestIsSeen(studio.page, await studio.picture()), 'in the studio').toBe(true);
  await studio.close();

  await post('streams', 'application/json', JSON.stringify({ name: 'layers', model: id }));
  const page = await browser.newPage({ viewport: { width: 300, height: 300 } });
  await page.goto(`${server.url}/view/layers`);
  await untilFace(page, 'playing', 'waiting');
  await eventually('the nearest layer is seen', async () => nearestIsSeen(page, await page.screenshot()));
  await page.close();
});
