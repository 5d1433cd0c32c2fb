import { createHash } from 'node:crypto';
import { describe, expect, it, vi } from 'vitest';
import { sha256, sha256Bytes } from '../../../../clients/js/sha256.ts';

const reference = (bytes: Uint8Array): string => createHash('sha256').update(bytes).digest('hex');
const bytesOf = (length: number): Uint8Array => Uint8Array.from({ length }, (_, i) => (i * 31 + 7) % 256);

describe('sha256', () => {
  it('Plain_EveryLengthAroundBlocks_EqualsTheReference', () => {
    for (let length = 0; length < 200; ++length) {
      expect(Buffer.from(sha256Bytes(bytesOf(length))).toString('hex')).toBe(reference(bytesOf(length)));
    }
    expect(Buffer.from(sha256Bytes(bytesOf(100_000))).toString('hex')).toBe(reference(bytesOf(100_000)));
  });

  it('WithAndWithoutThePlatforms_AreEqual', async () => {
    expect(await sha256(bytesOf(99))).toBe(reference(bytesOf(99)));
    vi.stubGlobal('crypto', undefined);
    expect(await sha256(bytesOf(99))).toBe(reference(bytesOf(99)));
    vi.unstubAllGlobals();
  });
});
