// The script of the page that greets: where it asks for a speech.
import { afterEach, expect, it, vi } from 'vitest';

interface Button {
  dataset: { text: string };
  lang: string;
  onclick?: () => Promise<void>;
}

afterEach(() => {
  vi.unstubAllGlobals();
  vi.resetModules();
});

it.each([
  ['http://127.0.0.1:8080', 'http://127.0.0.1:8080'],
  ['https://faces.example/talking/', 'https://faces.example/talking'],
  ['/faces', 'https://page.example/faces'],
  [null, 'https://page.example'],
])('src %s: the speech is asked of the server that the face follows', async (src, server) => {
  const button: Button = { dataset: { text: 'Hello!' }, lang: 'en' };
  const status = { textContent: '' };
  const face = { getAttribute: () => src, setSound: () => Promise.resolve(true) };
  const asked = vi.fn(() => Promise.resolve({ ok: true }));
  vi.stubGlobal('location', new URL('https://page.example/shop/greeting.html'));
  vi.stubGlobal('document', {
    querySelector: (what: string) => (what === 'semblante-face' ? face : status),
    querySelectorAll: () => [button],
  });
  vi.stubGlobal('fetch', asked);
  const script = '../../../../clients/js/greeting.js';
  await import(script);
  await button.onclick?.();
  expect(status.textContent).toBe('');
  expect(asked).toHaveBeenCalledWith(`${server}/v1/streams/demo/speech`, expect.anything());
});
