import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { startServer, type RunningServer } from './support/server.ts';
import { launch, StudioPage } from './support/studio_page.ts';

let server: RunningServer;
let browser: Browser;

beforeAll(async () => {
  [server, browser] = await Promise.all([startServer('edit'), launch()]);
});

afterAll(async () => {
  await browser?.close();
  await server?.stop();
});

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

  test('Invitation_InTheAddress_SignsInAndLeavesTheAddress', async () => {
    const studio = await StudioPage.open(browser, `${server.url}/#token=${server.token}`, { allowed, width: 390, height: 780 });
    await studio.waitForStage('ready');
    expect(studio.page.url()).not.toContain('token');
    expect(studio.errors).toEqual([]);
    await studio.context.close();
  });
});
