import { h } from './dom.ts';

/** Hands bytes to the browser, to be saved as a file. */
export function saveFile(content: Blob, name: string): void {
  const url = URL.createObjectURL(content);
  h('a', { href: url, download: name }).click();
  // The browser reads it after the click has returned.
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
