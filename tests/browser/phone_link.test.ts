import { describe, expect, test } from 'vitest';
import { shownFace, untilFace } from './support/face_page.ts';
import { patience } from './support/patience.ts';
import { calmDown, coarse, phone, StudioPage } from './support/studio_page.ts';
import { browser, server, useStudio } from './support/suite.ts';

useStudio({ demo: false, tokenScope: 'admin' });

async function createStream(title: string): Promise<void> {
  const response = await fetch(`${server.url}/v1/streams`, {
    method: 'POST',
    headers: { Authorization: `Bearer ${server.token}`, 'Content-Type': 'application/json' },
    body: JSON.stringify({ title, model: 'sample' }),
  });
  expect(response.status).toBe(201);
}

describe('a stream on a phone', () => {
  test('PrivateStream_IsOpenedByAnInvitation_AndByNothingElse', async () => {
    await createStream('Backstage');
    const studio = await StudioPage.open(browser, `${server.url}/#token=${server.token}`, { allowed: /status of 401/ });
    const { page } = studio;
    await studio.waitForStage('ready');
    await page.locator('#tab-live').click();
    await page.getByRole('button', { name: 'Show Backstage on a phone' }).click();
    const dialog = page.getByRole('dialog', { name: 'Backstage on a phone' });
    await dialog.getByText('exists on this machine only').waitFor();
    const address = dialog.getByLabel('Address');
    const plain = await address.inputValue();
    expect(plain).toMatch(new RegExp(`^${server.url}/view/[^/#]+$`));
    await dialog.getByRole('button', { name: 'Make an invitation' }).click();
    await dialog.getByText('Whoever has this address').waitFor();
    const invitation = await address.inputValue();
    expect(invitation.startsWith(`${plain}#token=smb_`)).toBe(true);
    await dialog.getByRole('button', { name: 'Close' }).click();
    await dialog.waitFor({ state: 'detached' });

    const stateOf = async (url: string): Promise<string> => {
      const context = await browser.newContext({ viewport: { width: 390, height: 844 }, deviceScaleFactor: coarse });
      await calmDown(context);
      context.setDefaultTimeout(patience);
      const viewer = await context.newPage();
      await viewer.goto(url, { waitUntil: 'domcontentloaded' });
      await untilFace(viewer, 'playing', 'error');
      const { state } = await shownFace(viewer);
      await context.close();
      return state;
    };
    expect(await stateOf(plain)).toBe('error');
    expect(await stateOf(invitation)).toBe('playing');
    expect(studio.errors).toEqual([]);
    await studio.context.close();
  });

  test('StudioOpenedOnTheServersOwnMachine_OffersItsAddressesInTheNetwork', async () => {
    await createStream('Foyer');
    const studio = await StudioPage.open(browser, `${server.url}/#token=${server.token}`, { ...phone, locale: 'pt-BR', allowed: /status of 401/ });
    const { page } = studio;
    // What a server with --lan answers (tests/deploy/tls_test.py).
    await page.route('**/v1/session', async (route) => {
      const response = await route.fetch();
      const urls = ['https://192.0.2.7:8443', 'https://[2001:db8::7]:8443'];
      await route.fulfill({ response, json: { ...((await response.json()) as object), network_urls: urls } });
    });
    await studio.waitForStage('ready');
    await page.locator('#tab-live').click();
    await page.getByRole('button', { name: 'Mostrar Foyer num celular' }).click();
    const dialog = page.getByRole('dialog', { name: 'Foyer num celular' });
    await dialog.getByRole('img', { name: 'Código QR do endereço' }).waitFor();
    const address = dialog.getByLabel('Endereço', { exact: true });
    expect(await address.inputValue()).toMatch(/^https:\/\/192\.0\.2\.7:8443\/view\/[^/#]+$/);
    await dialog.getByRole('button', { name: 'Fazer um convite' }).click();
    await dialog.getByText('Quem tiver este endereço').waitFor();
    await dialog.getByLabel('Esta máquina na rede').selectOption('[2001:db8::7]:8443');
    expect(await address.inputValue()).toMatch(/^https:\/\/\[2001:db8::7\]:8443\/view\/[^/#]+#token=smb_/);
    await studio.keep('phone-dialog-390-pt');
    expect(studio.errors).toEqual([]);
    await studio.close();
  });
});
