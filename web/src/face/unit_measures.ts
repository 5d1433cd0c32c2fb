import { fapus } from '@protocol/generated/mpeg4.ts';
import type { RigDocument, RigFapu, Vec3 } from '@protocol/rig_document.ts';

/** rig.json has the units divided by this. */
export const unitDivisor = 1024;

/** One unit of a face (FAPU) as a line on it. */
export interface UnitLine {
  unit: RigFapu;
  /** Model units; of two lines of one unit the same. */
  length: number;
  from: Vec3;
  to: Vec3;
}

/** The units that are lengths, in the standard's order. */
export const lengthUnits = fapus.filter(({ measures }) => measures.length > 0) as readonly (typeof fapus[number] & { name: RigFapu })[];

/**
 * The lines of a face's units: along the axis of each measure, about the middle between its two points, and as long as the
 * unit, whose value may have been given by hand. A measure without its points has none.
 */
export function unitLines({ fapu, feature_points }: Pick<RigDocument, 'fapu' | 'feature_points'>): UnitLine[] {
  const places = new Map(feature_points.map(({ id, position }) => [id, position]));
  return lengthUnits.flatMap(({ name, measures }) => {
    const value = fapu[name];
    if (value === null) return [];
    return measures.flatMap(({ from, to, axis }): UnitLine[] => {
      const a = places.get(from);
      const b = places.get(to);
      if (!a || !b) return [];
      const length = value * unitDivisor;
      const middle = (a[axis] + b[axis]) / 2;
      const at = (end: number): Vec3 => {
        const place: Vec3 = axis === 0 ? [0, (a[1] + b[1]) / 2, Math.max(a[2], b[2])] : [a[0], 0, Math.max(a[2], b[2])];
        place[axis] = middle + (end * length) / 2;
        return place;
      };
      return [{ unit: name, length, from: at(-1), to: at(1) }];
    });
  });
}

/** "62.3"; five digits at most, as few as show it. */
export const lengthWords = (length: number): string => String(Number(length.toPrecision(4)));
