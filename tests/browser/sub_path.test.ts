import { expect, test } from 'vitest';
import { untilFace } from './support/face_page.ts';
import { StudioPage } from './support/studio_page.ts';
import { SubPath } from './support/sub_path.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio();

test('StudioBelowAPathOfAProxy_ShowsHeads_AndFollowsAStream', async () => {
  const proxy = await SubPath.before(server, '/faces');
  const studio = await StudioPage.open(browser, `${proxy.address}/`, { motion: 'no-preference' });
  const { page } = studio;
  await studio.waitForStage('ready');
  await page.locator('#tab-live').click();
  await page.getByText('Live: Demo').first().waitFor(); // followed from the start
  await page.getByRole('button', { name: 'Show Demo on a phone' }).click();
  const dialog = page.getByRole('dialog', { name: 'Demo on a phone' });
  const link = await dialog.getByLabel('Address').inputValue();
  expect(link).toBe(`${proxy.address}/view/demo`);
  await page.goto(link, { waitUntil: 'domcontentloaded' });
  await untilFace(page, 'playing', 'error');
  expect(proxy.strays).toEqual([]);
  expect(studio.errors).toEqual([]);
  await studio.context.close();
  proxy.close();
});
