import { describe, expect, test } from 'vitest';
import { formatBytes } from '../src/ui/shared/format.ts';

describe('formatBytes', () => {
  test('FormatBytes_BelowAThousand_CountsBytes', () => expect(formatBytes(999)).toBe('999 B'));
  test('FormatBytes_RoundsIntoNextUnit_ChangesUnit', () => expect(formatBytes(999_700)).toBe('1.0 MB'));
  test('FormatBytes_Large_KeepsTwoDigits', () => expect(formatBytes(174_900)).toBe('175 kB'));
});
