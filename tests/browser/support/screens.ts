import type { Page } from 'playwright-core';
import { expect } from 'vitest';
import { keepsPictures } from './looks.ts';
import type { StudioPage } from './studio_page.ts';

/** What is done on each screen; `panel`: of the open tab, if it is longer than the page. */
export type Visit = (studio: StudioPage, screen: string, panel?: string) => Promise<void>;

const tabs = ['animate', 'fit', 'points', 'live'] as const;

/** Opens everything that is folded. */
const unfold = ({ page }: StudioPage): Promise<void> =>
  page.evaluate(() => document.querySelectorAll('details').forEach((one) => (one.open = true)));

/** The views that are switched on by hand, on a face with an expression and a viseme. */
async function showInfluence(page: Page, on: boolean): Promise<void> {
  for (const box of ['influence-view', 'units-view']) await page.locator(`#${box}`).setChecked(on);
  if (!on) return;
  await page.locator('[data-expression="1"]').click();
  await page.locator('[data-viseme="2"]').click();
}

/**
 * Goes to each screen of a page that shows the sample head: tabs, dialogs, findings, errors. The server has a stream and a head
 * "Odd" with findings; `refused`: a file that is no head.
 */
export async function goToEachScreen(studio: StudioPage, refused: string, visit: Visit): Promise<void> {
  const { page } = studio;
  const dialog = async (name: string): Promise<void> => {
    await page.locator('dialog[open]').waitFor();
    await visit(studio, name);
    await page.keyboard.press('Escape');
    await page.locator('dialog[open]').waitFor({ state: 'detached' });
  };
  await studio.waitForStage('ready');

  for (const tab of tabs) {
    await page.locator(`#tab-${tab}`).click();
    if (keepsPictures) await visit(studio, tab, `#panel-${tab}`); // unfolded it has all that it has folded
    if (tab === 'animate') await showInfluence(page, true);
    await unfold(studio);
    await visit(studio, `${tab}-unfolded`, `#panel-${tab}`);
    if (tab === 'animate') await showInfluence(page, false);
  }
  await page.locator('#tab-points').click();
  await page.locator('.points .section-head .segments button').last().click();
  await visit(studio, 'points-list');
  await page.locator('[data-point="8.1"]').click();
  await visit(studio, 'point-chosen');

  await page.locator('#tab-live').click();
  await page.locator('.stream .square').first().click();
  await dialog('dialog-phone');
  await page.locator('.live .section-head .square').first().click();
  await dialog('dialog-stream');
  await page.locator('#tab-live').press('?');
  await dialog('dialog-keys');

  await page.locator('#tab-animate').click();
  await page.getByRole('button', { name: /^(Code|Código)$/ }).click();
  await dialog('dialog-code');

  const shelfTab = page.locator('#tab-heads'); // on a narrow page, as phones and small laptops have
  if (await shelfTab.isVisible()) await shelfTab.click();
  await page.locator('.head').first().hover();
  await visit(studio, 'heads');
  await page.locator('.head-actions button').last().click();
  await dialog('dialog-deletion');
  await page.locator('.head-actions button').first().click();
  await dialog('dialog-name');

  // A head with findings and without points, and a file that is no head.
  await page.locator('.head', { hasText: 'Odd' }).locator('.open').click();
  await page.locator('#tab-fit').click();
  await page.locator('.finding-show').first().click();
  await unfold(studio);
  await visit(studio, 'findings', '#panel-fit');
  await page.locator('#tab-points').click();
  expect(await page.locator('#panel-points').evaluate((panel) => panel.scrollTop), 'another head is read from the top').toBe(0);
  await visit(studio, 'points-none');
  await page.locator('#tab-animate').click();
  await visit(studio, 'animate-none');
  await studio.drop(refused);
  await page.locator('.toast-error, .stage-card.error').first().waitFor();
  await visit(studio, 'refused');
  await page.route('**/v1/**', (route) => route.abort());
  await page.reload();
  await page.locator('.stage-card.error').waitFor();
  await visit(studio, 'no-server');
}

/** The tabs of a server without heads; they say the same, and one of them is enough where no pictures are kept. */
export async function goToEmptyScreens(studio: StudioPage, visit: Visit): Promise<void> {
  const { page } = studio;
  await page.locator('.stage-card, .stage-empty, .drop').first().waitFor();
  for (const tab of keepsPictures ? tabs : (['animate'] as const)) {
    await page.locator(`#tab-${tab}`).click();
    await visit(studio, `empty-${tab}`);
  }
}

/** The sign-in after a wrong token, of which it says `refused`. */
export async function goToSignIn(studio: StudioPage, refused: string, visit: Visit): Promise<void> {
  const { page } = studio;
  await page.getByLabel('Token').fill('smb_wrong_token');
  await page.getByLabel('Token').press('Enter');
  await page.getByRole('alert').getByText(refused).waitFor();
  await visit(studio, 'sign-in');
}
