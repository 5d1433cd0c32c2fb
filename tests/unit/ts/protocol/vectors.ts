import { readFileSync } from 'node:fs';

const folder = new URL('../../../../protocol/vectors/v1/', import.meta.url);

export const vectorBytes = (name: string): Uint8Array => new Uint8Array(readFileSync(new URL(name, folder)));
export const vectorJson = (name: string): unknown => JSON.parse(readFileSync(new URL(name, folder), 'utf8'));

export const fromHex = (hex: string): Uint8Array => Uint8Array.from(hex.match(/../g) ?? [], (pair) => parseInt(pair, 16));
export const toHex = (bytes: Uint8Array): string =>
  Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('');
