import { describe, expect, it } from 'vitest';

import { formatsOf } from '../src/ui/shared/recording_formats.ts';

describe('recording formats', () => {
  it('Sound_IsOffered_UnlessTheRecordingHasNone', () => {
    const offered = (sound: boolean | null): boolean => formatsOf(sound).some(([format]) => format === 'opus');
    expect([true, null, false].map(offered)).toEqual([true, true, false]);
    expect(formatsOf(false).length).toBe(formatsOf(true).length - 1);
  });
});
