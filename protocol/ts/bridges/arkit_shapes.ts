import { arkitSettings, arkitShapes } from '../generated/arkit.ts';

export const arkitCount = arkitShapes.length;
/** ARKit's 52 blend shapes, in the order of Live Link Face's stream. */
export const arkitNames: readonly string[] = arkitShapes.map((shape) => shape.name);

const index = new Map(arkitNames.map((name, i) => [name, i]));

/** The index of a shape by ARKit's name ("jawOpen") or Live Link's ("JawOpen"). */
export function findArkit(name: string): number | undefined {
  return index.get(name.charAt(0).toLowerCase() + name.slice(1));
}

export const shapeIndex = (name: string): number => index.get(name)!;

/** The change of a FAP by a shape at coefficient 1, FAP units. */
export const amount = (shape: number, fap: number): number =>
  arkitShapes[shape]!.faps.find(([number]) => number === fap)?.[1] ?? 0;

/** The FAPs and shapes of one eye and its lids. */
export interface Eye {
  blink: number;
  lookDown: number;
  lookIn: number;
  lookOut: number;
  lookUp: number;
  squint: number;
  wide: number;
  upperLid: number;
  lowerLid: number;
  yaw: number;
  pitch: number;
  /** Sign of the yaw FAP when the eye looks away from the nose. */
  outwards: 1 | -1;
}
const eye = (side: 'Left' | 'Right', upperLid: number, outwards: 1 | -1): Eye => ({
  blink: shapeIndex(`eyeBlink${side}`),
  lookDown: shapeIndex(`eyeLookDown${side}`),
  lookIn: shapeIndex(`eyeLookIn${side}`),
  lookOut: shapeIndex(`eyeLookOut${side}`),
  lookUp: shapeIndex(`eyeLookUp${side}`),
  squint: shapeIndex(`eyeSquint${side}`),
  wide: shapeIndex(`eyeWide${side}`),
  upperLid,
  lowerLid: upperLid + 2,
  yaw: upperLid + 4,
  pitch: upperLid + 6,
  outwards,
});
export const eyes: readonly Eye[] = [eye('Left', 19, 1), eye('Right', 20, -1)];

export const jawOpen = shapeIndex('jawOpen');
export const mouthClose = shapeIndex('mouthClose');
export const mouthFunnel = shapeIndex('mouthFunnel');
export const mouthPucker = shapeIndex('mouthPucker');
export const tongueOut = shapeIndex('tongueOut');

/** The sum of FAPs 19 and 21 for closed lids: IRISD. */
export const lidsShut = 1024;
export const lowerLidShut = (1 - arkitSettings.upper_lid_share) * lidsShut;
/** The rotation of an eye at a look coefficient of 1, FAP units. */
export const fullTurn = ((arkitSettings.eye_full_turn_degrees * Math.PI) / 180) * 1e5;
