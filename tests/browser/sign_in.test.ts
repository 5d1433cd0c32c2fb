import { describe, expect, test } from 'vitest';
import { StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ tokenScope: 'edit' });

// A refused sign-in is logged by the browser as a failed request.
const allowed = /status of 401/;

describe('a server that asks for tokens', () => {
  test('SignIn_WrongThenRightToken_OpensTheStudio_AndScriptsCannotReadIt', async () => {
    const studio = await StudioPage.open(browser, server.url, { allowed });
    const { page } = studio;
    await page.getByLabel('Token').fill('smb_wrong_token');
    await page.getByRole('button', { name: 'Sign in' }).click();
    await page.getByRole('alert').getByText('not accepted').waitFor();
    await page.getByLabel('Token').fill(server.token);
    await page.getByRole('button', { name: 'Sign in' }).click();
    await studio.waitForStage('ready');
    expect(await page.evaluate(() => document.cookie)).toBe('');

    await page.locator('#tab-live').click();
    await page.getByLabel('About the stream').getByText('The server’s demo').waitFor();
    await page.reload();
    await studio.waitForStage('ready');

    await page.getByRole('button', { name: 'Sign out' }).click();
    await page.getByLabel('Token').waitFor();
    expect(studio.errors).toEqual([]);
    await studio.context.close();
  });

  test('SignedOut_ByTheServer_SaysSoAndSignsInOverThePage', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#token=${server.token}`, { allowed });
    const { page, context } = studio;
    await studio.waitForStage('ready');
    const text = page.locator('#panel-animate textarea').first();
    await text.fill('This stays');
    await context.clearCookies(); // the server answers as to a token that has been revoked
    await page.locator('#tab-live').click();
    const note = page.locator('.signed-out-note');
    await note.getByRole('button', { name: 'Sign in' }).click();
    const dialog = page.getByRole('dialog');
    await dialog.getByLabel('Token').fill(server.token);
    await dialog.getByRole('button', { name: 'Sign in' }).click();
    await note.waitFor({ state: 'hidden' });
    await dialog.waitFor({ state: 'detached' });
    await page.locator('.stream').first().waitFor();
    expect(await text.inputValue()).toBe('This stays');
    expect(studio.errors).toEqual([]);
    await studio.context.close();
  });

  test('Invitation_InTheAddress_SignsInAndLeavesTheAddress', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#token=${server.token}`, { allowed, width: 390, height: 780 });
    await studio.waitForStage('ready');
    expect(studio.page.url()).not.toContain('token');
    expect(studio.errors).toEqual([]);
    await studio.context.close();
  });
});
