import { join } from 'node:path';
import { expect, test } from 'vitest';
import { faces } from './support/paths.ts';
import { StudioPage, type Inside } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false });

const head = faces === null ? '' : join(faces, 'ict-facekit');

/** What the open head wears in place of the library's expressions, as the server has it. */
async function worn(studio: StudioPage): Promise<string[]> {
  const id = await studio.page.evaluate(() => (window as unknown as Inside).semblante.studio.selected.value!.id);
  return Object.keys(((await (await fetch(`${server.url}/v1/models/${id}`)).json()) as { expressions: object }).expressions).sort();
}

test.skipIf(faces === null)('Scans_OfAHeadInExpressions_BecomeItsOwnAndAreTakenOff', async () => {
  const studio = await StudioPage.open(browser, server.url, { width: 1280, height: 720 });
  const { page } = studio;
  await studio.waitForStage('ready');
  await studio.drop(join(head, 'neutral.obj'));
  await studio.waitForState('ready');
  await studio.waitForStage('ready');
  await studio.drop(join(head, 'ict-facekit.fps.json'));
  await page.getByText(/feature points read from/).waitFor();
  await page.getByRole('button', { name: 'Make it move (parametrize)' }).last().click();
  await studio.waitForState('parametrized');
  await studio.waitForStage('ready');

  await page.getByText('From scans of this head').click();
  const scans = ['mouthSmile', 'eyeWide', 'jawOpen'].map((name) => join(head, `expressions/${name}.obj`));
  await page.getByLabel('Choose scans').setInputFiles([...scans, join(head, '../mediapipe-canonical/canonical_face_model.obj')]);
  const shows = (name: string): ReturnType<typeof page.getByLabel> => page.getByLabel(`What ${name} shows`);
  await shows('mouthSmile.obj').selectOption('joy');
  await shows('eyeWide.obj').selectOption('surprise');
  await shows('jawOpen.obj').selectOption('a');
  await shows('canonical_face_model.obj').selectOption('fear');
  await page.locator('.scans').scrollIntoViewIfNeeded();
  await studio.keep('scans');
  await page.getByRole('button', { name: 'Make them its own' }).click();
  await page.getByText('3 expressions are its own now.').waitFor();
  expect(await worn(studio)).toEqual(['a', 'joy', 'surprise']);
  // The head of another mesh gives nothing, and says why.
  await page.locator('.scans .notice').getByText(/468 vertices/).waitFor();
  await studio.keep('scans-worn');

  await studio.waitForStage('ready');
  await page.getByRole('button', { name: 'Joy: the library’s again' }).click();
  await page.getByRole('button', { name: 'Joy: the library’s again' }).waitFor({ state: 'detached' });
  expect(await worn(studio)).toEqual(['a', 'surprise']);
  const { sets } = (await (await fetch(`${server.url}/v1/expressions`)).json()) as { sets: object[] };
  expect(sets).toEqual([]); // the head has copies
  expect(studio.errors).toEqual([]);
  await studio.close();
});
