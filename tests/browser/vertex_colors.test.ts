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

/** The sample head whose skin has green vertices in place of its material. */
function greenHead(): Uint8Array<ArrayBuffer> {
  const head = new EditedGlb(sampleHead);
  const { meshes, accessors } = head.gltf;
  for (const { primitives } of meshes.filter(({ name }) => /^(skin|upper lids)$/.test(name))) {
    for (const primitive of primitives) {
      const { count } = accessors[primitive.attributes['POSITION']!]!;
      const colors = Uint8Array.from({ length: 4 * count }, (_, i) => [20, 160, 40, 255][i % 4]!);
      primitive.attributes['COLOR_0'] = head.addAccessor(colors, 'VEC4', count, { normalized: true });
      delete primitive.material;
    }
  }
  return head.bytes();
}

test('VertexColors_OfAnUploadedHead_AreShownAsPreviewAsFaceAndOnThePageOfAStream', async () => {
  const id = await uploadHead('green', greenHead());
  const preview = await StudioPage.open(browser, `${server.url}/#${id}`);
  await preview.waitForStage('ready');
  expect(await middleOf(preview.page, await preview.picture()), 'the imported model').toSatisfy(isGreen);
  await preview.close();

  await parametrizeAsSample(id);
  const studio = await StudioPage.open(browser, `${server.url}/#${id}`);
  await studio.waitForStage('ready');
  expect(await middleOf(studio.page, await studio.picture()), 'the face in the studio').toSatisfy(isGreen);
  await studio.close();

  await post('streams', 'application/json', JSON.stringify({ name: 'green', model: id }));
  const page = await browser.newPage({ viewport: { width: 300, height: 300 } });
  await page.goto(`${server.url}/view/green`);
  await untilFace(page, 'playing', 'waiting');
  await eventually('the face is green', async () => isGreen(await middleOf(page, await page.screenshot())));
  await page.close();
});
