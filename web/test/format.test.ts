import { describe, expect, test } from 'vitest';
import { formatBytes, withShortSizes } from '../src/ui/shared/format.ts';

test('WithShortSizes_LongNumbersOfBytes_AreShort', () => {
  expect(withShortSizes('At most 268435456 bytes are accepted here, byte 12 of 100 bytes')).toBe('At most 268 MB are accepted here, byte 12 of 100 bytes');
});

describe('formatBytes', () => {
  test('FormatBytes_BelowAThousand_CountsBytes', () => expect(formatBytes(999)).toBe('999 B'));
  test('FormatBytes_RoundsIntoNextUnit_ChangesUnit', () => expect(formatBytes(999_700)).toBe('1.0 MB'));
  test('FormatBytes_Large_KeepsTwoDigits', () => expect(formatBytes(174_900)).toBe('175 kB'));
});
