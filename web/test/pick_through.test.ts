import { describe, expect, test } from 'vitest';
import { featurePointNames, featurePoints } from '@protocol/generated/mpeg4.ts';
import { pickThrough, rolesOfPoint, type Meeting } from '../src/view/pick_through.ts';

const met = (distance: number, role: Meeting['role'], outside = true): Meeting => ({ distance, role, outside });

describe('picking', () => {
  test('PickThrough_LashesGlassesAndHairBeforeTheSkin_FindsTheSkin', () => {
    const along = [met(10, 'attached'), met(10.2, 'rest'), met(10.5, 'skin'), met(14, 'skin', false)];
    expect(pickThrough(along, ['skin'], 2)).toBe(2);
  });

  test('PickThrough_SkinTooFarBehindOrFromInside_TakesWhatIsSeen', () => {
    // Through an open mouth: the teeth, then the back of the head from inside.
    expect(pickThrough([met(10, 'upper_teeth'), met(11, 'skin', false)], ['skin'], 2)).toBe(0);
    // Past the ear: hair, then the other ear.
    expect(pickThrough([met(10, 'rest'), met(13, 'skin')], ['skin'], 2)).toBe(0);
  });

  test('PickThrough_PupilBehindAShell_PrefersTheEyeToTheSkin', () => {
    const along = [met(10, 'rest'), met(10.1, 'skin'), met(10.2, 'left_eye')];
    expect(pickThrough(along, rolesOfPoint('3.5'), 1)).toBe(2);
    expect(pickThrough(along, rolesOfPoint('3.1'), 1)).toBe(1);
  });

  test('PickThrough_NothingOrNoRoles_GivesNoneOrTheFirst', () => {
    expect(pickThrough([], ['skin'], 1)).toBe(-1);
    expect(pickThrough([met(10, null), met(11, null)], ['skin'], 2)).toBe(0);
  });

  test('RolesOfPoint_OfTheStandard_AreTonguesTeethEyesAndSkin', () => {
    const by = Object.fromEntries(featurePoints.map(({ id }) => [id, rolesOfPoint(id)[0]]));
    expect(featurePoints.filter(({ id }) => by[id] === 'tongue')).toHaveLength(4);
    for (const [index, { id }] of featurePoints.entries()) {
      const name = featurePointNames[index]!;
      const teeth = /teeth|tooth/i.test(name);
      expect(teeth, `${id} ${name}`).toBe(by[id] === 'upper_teeth' || by[id] === 'lower_teeth');
      if (teeth) expect(by[id], `${id} ${name}`).toBe(/lower/i.test(name) ? 'lower_teeth' : 'upper_teeth');
    }
  });
});
