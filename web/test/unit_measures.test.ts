import { expect, test } from 'vitest';
import { fapus } from '@protocol/generated/mpeg4.ts';
import type { RigDocument, Vec3 } from '@protocol/rig_document.ts';
import { lengthUnits, lengthWords, unitDivisor, unitLines } from '../src/face/unit_measures.ts';

const places: Record<string, Vec3> = {
  '3.1': [3, 10.5, 5],
  '3.3': [3, 9.5, 5],
  '3.5': [3, 10, 5],
  '3.6': [-3, 10, 5],
  '9.15': [0, 6, 7],
  '2.2': [0, 4, 6],
  '8.3': [2.5, 3.8, 5],
  '8.4': [-2.5, 4.2, 5],
};
const face = (fapu: Partial<RigDocument['fapu']>): Pick<RigDocument, 'fapu' | 'feature_points'> => ({
  fapu: { IRISD: null, ES: null, ENS: null, MNS: null, MW: null, ...fapu },
  feature_points: Object.entries(places).map(([id, position]) => ({ id, vertex: null, position })),
});

test('LengthUnits_OfTheStandard_AreAllButTheAngle', () => {
  expect(lengthUnits.map(({ name }) => name)).toEqual(['IRISD', 'ES', 'ENS', 'MNS', 'MW']);
  expect(fapus.find(({ name }) => name === 'AU')!.measures).toEqual([]);
});

test('UnitLines_MeasuredUnits_LieBetweenTheirPoints', () => {
  const fapu = { IRISD: 1 / unitDivisor, ES: 6 / unitDivisor, ENS: 4 / unitDivisor, MNS: 2 / unitDivisor, MW: 5 / unitDivisor };
  const lines = unitLines(face(fapu));
  // The right eye has no points of lids here, so IRISD has one line.
  expect(lines.map(({ unit, length }) => [unit, length])).toEqual([['IRISD', 1], ['ES', 6], ['ENS', 4], ['MNS', 2], ['MW', 5]]);
  const by = Object.fromEntries(lines.map((line) => [line.unit, line]));
  expect(by['IRISD']).toMatchObject({ from: [3, 9.5, 5], to: [3, 10.5, 5] });
  expect(by['ES']).toMatchObject({ from: [-3, 10, 5], to: [3, 10, 5] });
  expect(by['ENS']).toMatchObject({ from: [0, 6, 7], to: [0, 10, 7] });
  expect(by['MNS']).toMatchObject({ from: [0, 4, 7], to: [0, 6, 7] });
  expect(by['MW']).toMatchObject({ from: [-2.5, 4, 5], to: [2.5, 4, 5] });
});

test('UnitLines_AUnitGivenByHand_IsAsLongAsItSays', () => {
  const [line] = unitLines(face({ MW: 7 / unitDivisor }));
  expect(line).toMatchObject({ unit: 'MW', length: 7, from: [-3.5, 4, 5], to: [3.5, 4, 5] });
  expect(unitLines(face({}))).toEqual([]);
});

test('LengthWords_AnyScale_HaveFourDigits', () => {
  expect([62.34567, 0.0623456, 6, 1234.4].map(lengthWords)).toEqual(['62.35', '0.06235', '6', '1234']);
});
