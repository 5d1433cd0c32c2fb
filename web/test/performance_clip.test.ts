import { readFileSync } from 'node:fs';
import { beforeAll, describe, expect, test } from 'vitest';
import { Performance, type Library } from '@client/motion/index.ts';
import { ProtocolError } from '@protocol/protocol_error.ts';
import { loadLibrary } from '../../tests/unit/ts/support/runtime.ts';
import { ClipPlayer } from '../src/face/clip.ts';
import { clipOf, kindOfClip, readClipFile, type ClipKind } from '../src/face/clip_file.ts';
import { fineSteps } from '../src/face/fine_steps.ts';
import { PerformanceClip } from '../src/face/performance_clip.ts';

let library: Library;
beforeAll(async () => {
  library = await loadLibrary();
});
const perform = (text: string): Performance => new Performance(library, text);

const hello = readFileSync(new URL('../../protocol/examples/performances/hello.json', import.meta.url), 'utf8');
const idleText = '{"format": "semblante.performance", "version": 1, "idle": {"seed": 3, "head": 1}}';
const levelsAt = (clip: PerformanceClip, position: number, lap = 0): [number[], number[], number] => {
  const { from, to, t } = clip.momentAt(position, lap);
  return [[...from.state.levels], [...to.state.levels], t];
};

describe('performance clip', () => {
  test('Moment_AnywhereInAnyOrder_IsThePerformanceThere', () => {
    const performance = perform(hello);
    const clip = new PerformanceClip(performance, hello);
    expect(clip.duration).toBe(performance.duration);
    for (const position of [0, 7, 20, 33, 1234.5, 1250, 300, clip.duration]) {
      const { from, to } = clip.momentAt(position);
      expect(from.time).toBe(position);
      expect(from.state).toEqual(performance.frameAt(position, position, fineSteps));
      expect(to).toBe(from);
    }
    expect(clip.momentAt(-1).from.time).toBe(0);
    expect(clip.momentAt(1e9).from.time).toBe(clip.duration);
  });

  test('IdleAlone_HasNoEnd_AndGoesOn', () => {
    const file = readClipFile(library, 'performance', idleText);
    const clip = clipOf(library, file, 'zero');
    expect(clip.duration).toBe(Infinity);
    const player = new ClipPlayer();
    player.loop = true;
    player.load(clip);
    player.play();
    player.step(0);
    const rest = [...player.step(1)!.from.state.levels];
    expect([...player.step(3600)!.from.state.levels]).not.toEqual(rest);
    expect([player.position, player.playing]).toEqual([3_601_000, true]);
  });

  test('Loop_IdleLife_RunsOnWhereTheCuesBeginAgain', () => {
    const text = idleText.replace('}}', '}, "duration": 1000, "cues": [{"time": 0, "duration": 900, "viseme": "o"}]}');
    const clip = new PerformanceClip(perform(text), text);
    const end = levelsAt(clip, 1000)[0];
    const again = levelsAt(clip, 0, 1)[0];
    expect(again).toEqual(end);
    expect(levelsAt(clip, 500, 1)[0]).not.toEqual(levelsAt(clip, 500, 0)[0]);
    const player = new ClipPlayer();
    player.loop = true;
    player.load(clip);
    player.play();
    player.step(0);
    const { from } = player.step(3.5)!;
    expect([from.time, [...from.state.levels]]).toEqual([500, levelsAt(clip, 500, 3)[0]]);
  });

  test('File_OfMotion_IsWhatItsTextSays_WhateverItsName', () => {
    for (const name of ['a.fap', 'a.json', 'a.txt', 'a']) {
      expect(kindOfClip(name, hello), name).toBe('performance');
      expect(kindOfClip(name, '# a take\n2.1 hello 25 2\n'), name).toBe('fap');
    }
    expect(kindOfClip('a.FAP', 'rubbish')).toBe('fap');
    expect(kindOfClip('a.json', 'rubbish')).toBe('performance');
  });

  test('File_WithAFault_NamesItsPointerOrItsLine', () => {
    const where = (kind: ClipKind, text: string): string => {
      try {
        readClipFile(library, kind, text);
      } catch (error) {
        if (error instanceof ProtocolError) return error.where;
        throw error;
      }
      return 'nowhere';
    };
    expect(where('performance', hello.replace('"viseme": "n_l"', '"viseme": "xyz"'))).toBe('/cues/3/viseme');
    expect(where('fap', hello)).toMatch(/^line 1/);
    expect(where('performance', hello)).toBe('nowhere');
  });
});
