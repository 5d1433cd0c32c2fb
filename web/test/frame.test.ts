import { describe, expect, test } from 'vitest';
import { neutralFrame } from '@client/index.ts';
import {
  clearFrame,
  expressionIntensity,
  fapValue,
  isNeutral,
  mirrorFrame,
  setExpression,
  setFap,
  setVisemes,
  shutEyes,
} from '../src/face/frame.ts';

describe('frame by hand', () => {
  test('SetVisemes_HalfShare_BlendsWithSilence', () => {
    const frame = neutralFrame();
    setVisemes(frame, 10, 0, 0.5);
    expect(frame.viseme).toEqual({ select1: 10, select2: 0, blend: 32 }); // round(0.5 * 63) = 32
  });

  test('SetVisemes_Silence_IsNeutral', () => {
    const frame = neutralFrame();
    setVisemes(frame, 10, 0, 1);
    setVisemes(frame, 0, 0, 1);
    expect(isNeutral(frame)).toBe(true);
  });

  test('SetExpression_Third_TakesThePlaceOfTheWeaker', () => {
    const frame = neutralFrame();
    setExpression(frame, 1, 20);
    setExpression(frame, 3, 40);
    expect(setExpression(frame, 6, 63)).toBe(1);
    expect([1, 3, 6].map((e) => expressionIntensity(frame, e))).toEqual([0, 40, 63]);
  });

  test('SetExpression_BackToZero_FreesItsPlace', () => {
    const frame = neutralFrame();
    setExpression(frame, 1, 20);
    setExpression(frame, 3, 40);
    setExpression(frame, 1, 0);
    expect(setExpression(frame, 6, 63)).toBe(0);
    expect(expressionIntensity(frame, 3)).toBe(40);
  });

  test('SetFap_BothSides_LipCornersMirror', () => {
    const frame = neutralFrame();
    expect(setFap(frame, 6, 100, true)).toBe(7); // stretch_l_cornerlip and stretch_r_cornerlip, both outwards
    expect([fapValue(frame, 6), fapValue(frame, 7)]).toEqual([100, 100]);
  });

  test('SetFap_BothSides_EyesLookTheSameWay', () => {
    const frame = neutralFrame();
    setFap(frame, 23, 5120, true); // yaw_l_eyeball: parallel gaze has equal values; 5120 = 40 steps of 128
    expect(fapValue(frame, 24)).toBe(5120);
  });

  test('SetFap_OneSide_LeavesTheOtherAlone', () => {
    const frame = neutralFrame();
    setFap(frame, 6, 100, false);
    expect(fapValue(frame, 7)).toBe(0);
  });

  test('SetFap_InTheMiddle_HasNoPartner', () => expect(setFap(neutralFrame(), 3, 100, true)).toBe(0));

  test('ClearFrame_AfterEverything_IsNeutral', () => {
    const frame = neutralFrame();
    setVisemes(frame, 4, 0, 1);
    setExpression(frame, 2, 30);
    setFap(frame, 3, 100, true);
    expect(isNeutral(frame)).toBe(false);
    clearFrame(frame);
    expect(isNeutral(frame)).toBe(true);
  });

  test('Mirror_Twice_IsAsBefore_AndOnceExchangesSides', () => {
    const frame = neutralFrame();
    setFap(frame, 12, 200, false); // one corner of the lips
    setFap(frame, 49, 20_000, false); // the head turns
    setFap(frame, 3, 400, false); // the jaw has no side
    const before = frame.levels.slice();
    mirrorFrame(frame);
    expect([frame.levels[12], frame.levels[13]]).toEqual([0, before[12]]);
    expect(frame.levels[49]).toBe(-before[49]!);
    expect(frame.levels[3]).toBe(before[3]);
    mirrorFrame(frame);
    expect(frame.levels).toEqual(before);
  });

  test('ShutEyes_AndOpen_LeavesWhatWasMovedMeanwhile', () => {
    const frame = neutralFrame();
    setFap(frame, 19, 300, true);
    const open = shutEyes(frame);
    expect(fapValue(frame, 19) + fapValue(frame, 21)).toBeGreaterThan(1000);
    setFap(frame, 20, 100, false);
    open();
    expect(fapValue(frame, 19)).toBeCloseTo(300, -1);
    expect(fapValue(frame, 20)).toBeCloseTo(100, -1);
    expect(frame.levels[21]).toBe(0);
  });
});
