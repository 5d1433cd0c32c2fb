import { arkitRotationNames } from '../generated/arkit.ts';
import { faps } from '../generated/mpeg4.ts';
import type { JsonCursor } from '../json_cursor.ts';
import { arkitCount, findArkit } from './arkit_shapes.ts';
import { clamp, neutralValues, type FaceValues } from './face_values.ts';
import { valuesFromArkit } from './from_arkit.ts';
import { findOculus, fromOculus, oculusCount } from './oculus.ts';

const withRotations = arkitCount + arkitRotationNames.length;
const rotations = new Map(arkitRotationNames.map((name, i) => [name as string, arkitCount + i]));

/** Reads a coefficient, clamped to +-1e6; the bridge clamps it further. */
const coefficient = (at: JsonCursor): number => clamp(at.number(), -1e6, 1e6);

/** Sets FAPs 48 (pitch, down), 49 (yaw to the left; the angle's sign is to the right) and 50 (roll) from radians. */
function turnHead(values: FaceValues, yaw: number, pitch: number, roll: number): void {
  for (const [number, angle] of [[48, pitch], [49, -yaw], [50, roll]] as const) {
    const { min, max } = faps[number - 1]!;
    values.faps[number] = clamp(angle * 1e5, min, max);
  }
}

function readArkit(at: JsonCursor): FaceValues {
  const all = new Float64Array(withRotations);
  if (at.isArray) {
    const elements = at.elements(arkitCount, withRotations);
    if (elements.length !== arkitCount && elements.length !== withRotations) {
      at.fail('out_of_range', 'must have 52 elements, or 61 with the angles of head and eyes');
    }
    elements.forEach((element, i) => (all[i] = coefficient(element)));
  } else {
    for (const [name, value] of at.members()) {
      const shape =
        findArkit(name) ??
        rotations.get(name.charAt(0).toLowerCase() + name.slice(1)) ??
        value.fail('invalid_argument', "is not one of ARKit's 52 shapes or an angle of head or eyes");
      all[shape] = coefficient(value);
    }
  }
  const { values } = valuesFromArkit(all.subarray(0, arkitCount));
  turnHead(values, all[arkitCount]!, all[arkitCount + 1]!, all[arkitCount + 2]!);
  return values;
}

function readOculus(at: JsonCursor): FaceValues['viseme'] {
  const weights = new Float64Array(oculusCount);
  if (at.isArray) {
    at.elements(oculusCount, oculusCount).forEach((element, v) => (weights[v] = coefficient(element)));
  } else {
    for (const [name, value] of at.members()) {
      const viseme =
        findOculus(name) ??
        value.fail('invalid_argument', 'is not one of the visemes sil PP FF TH DD kk CH SS nn RR aa E ih oh ou');
      weights[viseme] = coefficient(value);
    }
  }
  return fromOculus(weights).frame.viseme;
}

/** Reads the members `arkit` and `oculus` of a frame; undefined when it has neither. */
export function readJsonBridges(frame: JsonCursor): FaceValues | undefined {
  const arkit = frame.optional('arkit');
  const oculus = frame.optional('oculus');
  if (!arkit && !oculus) return undefined;
  if (oculus && frame.optional('viseme')) oculus.fail('invalid_argument', 'is not allowed beside `viseme`');
  const values = arkit ? readArkit(arkit) : neutralValues();
  if (oculus) values.viseme = readOculus(oculus);
  return values;
}
