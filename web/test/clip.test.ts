import { readFileSync } from 'node:fs';
import { beforeAll, describe, expect, test } from 'vitest';
import { neutralFrame, type TimedFrame } from '@client/index.ts';
import type { Library } from '@client/motion/index.ts';
import { loadLibrary } from '../../tests/unit/ts/support/runtime.ts';
import { ClipPlayer, FrameClip } from '../src/face/clip.ts';
import { clipOf, readClipFile } from '../src/face/clip_file.ts';

let library: Library;
beforeAll(async () => {
  library = await loadLibrary();
});

const at = (time: number): TimedFrame => ({ time, state: neutralFrame() });
const clip = (): FrameClip => new FrameClip([at(0), at(40), at(80), at(1000)]);
const times = (one: FrameClip, position: number): [number, number, number] => {
  const { from, to, t } = one.momentAt(position);
  return [from.time, to.time, t];
};

describe('clip', () => {
  test('Moment_AnywhereInAnyOrder_LiesBetweenItsFrames', () => {
    const one = clip();
    expect(times(one, 0)).toEqual([0, 40, 0]);
    expect(times(one, 60)).toEqual([40, 80, 0.5]);
    expect(times(one, 1000)).toEqual([1000, 1000, 0]);
    expect(times(one, 10)).toEqual([0, 40, 0.25]);
    expect(times(one, 540)).toEqual([80, 1000, 0.5]);
    expect(times(one, 41)[0]).toBe(40);
  });

  test('Moment_OfOneFrame_IsThatFrame', () => expect(times(new FrameClip([at(0)]), 500)).toEqual([0, 0, 0]));

  test('Clip_WithoutFrames_Throws', () => expect(() => new FrameClip([])).toThrow(RangeError));

  test('FapFile_WhatAFrameLeavesOut_IsZeroOrStays', () => {
    const text = readFileSync(new URL('../../protocol/vectors/fap/mask_changes.fap', import.meta.url), 'utf8');
    const file = readClipFile(library, 'fap', text);
    const levels = (absent: 'zero' | 'keep'): number[] =>
      (clipOf(library, file, absent) as FrameClip).frames.map(({ state }) => state.levels.filter((level) => level !== 0).length);
    const [zero, keep] = [levels('zero'), levels('keep')];
    expect(keep).not.toEqual(zero);
    keep.forEach((count, i) => expect(count).toBeGreaterThanOrEqual(zero[i]!));
  });
});

describe('clip player', () => {
  test('Step_WhilePlaying_GoesToTheEndAndStops', () => {
    let ends = 0;
    const player = new ClipPlayer(() => (ends += 1));
    player.load(clip());
    player.play();
    expect(player.step(0.016)?.t).toBe(0); // the first picture is the beginning
    player.step(0.5);
    expect(player.position).toBe(500);
    player.step(2);
    expect([player.position, player.playing, ends]).toEqual([1000, false, 1]);
    expect(player.step(0.016)).toBeNull();
    player.play(); // from the end: again from the beginning
    expect(player.position).toBe(0);
  });

  test('Loop_PastTheEnd_BeginsAgain', () => {
    const player = new ClipPlayer();
    player.loop = true;
    player.load(clip());
    player.play();
    player.step(0);
    player.step(2.25);
    expect([player.position, player.playing]).toEqual([250, true]);
  });

  test('Seek_WhilePaused_ShowsOneMoment', () => {
    const player = new ClipPlayer();
    player.load(clip());
    player.seek(60);
    expect(player.step(0.016)?.from.time).toBe(40);
    expect(player.step(0.016)).toBeNull();
    player.seek(-5);
    expect(player.position).toBe(0);
  });

  test('Load_ReadOtherwise_KeepsItsPlaceAndGoesOn', () => {
    const player = new ClipPlayer();
    player.load(clip());
    player.play();
    player.seek(300);
    player.load(clip(), true);
    expect([player.position, player.playing]).toEqual([300, true]);
    player.load(clip());
    expect([player.position, player.playing]).toEqual([0, false]);
  });

  test('Pause_WithoutAClip_OrWithOne_ShowsNothingMore', () => {
    const player = new ClipPlayer();
    player.play();
    expect(player.playing).toBe(false);
    player.load(clip());
    player.play();
    player.pause();
    expect(player.step(0.1)).toBeNull();
  });
});
