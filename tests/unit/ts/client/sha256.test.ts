import { createHash } from 'node:crypto';
import { expect, it } from 'vitest';
import { sha256 } from '../../../../clients/js/sha256.ts';
import { loadRuntime } from '../support/runtime.ts';

it('Sha256_AllLengthsAroundABlock_AndALongText_EqualOpenSsl', async () => {
  const runtime = await loadRuntime();
  for (const length of [...Array.from({ length: 140 }, (_, i) => i), 100_000]) {
    const bytes = Uint8Array.from({ length }, (_, i) => (i * 31 + length) & 0xff);
    expect(sha256(runtime, bytes), `${length}`).toBe(createHash('sha256').update(bytes).digest('hex'));
  }
});
