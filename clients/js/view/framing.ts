import type { RigDocument } from '../../../protocol/ts/rig_document.ts';
import type { Subject, Vec3 } from './camera.ts';

/** `head`: the whole head, also of a body. `face`: brows to chin. `model`: everything. */
export type Fit = 'head' | 'face' | 'model';

/** Parts of the distance from the eyes to the chin, of heads of all kinds. */
const crownAboveEyes = 1.12;
const browAboveEyes = 0.55;
const halfWidth = 0.92;
const halfDepth = 0.9;

/** The box that the camera shows. A head is measured by its feature points; without eyes and chin the model is shown. */
export function frameOf(rig: RigDocument, fit: Fit): Subject {
  const { min, max } = rig.bounds;
  const whole = boxOf(min, max);
  if (fit === 'model') return whole;
  const places = new Map<string, Vec3>();
  for (const { id, position } of rig.feature_points) if (position) places.set(id, [...position] as Vec3);
  const eyes = ['3.7', '3.8', '3.11', '3.12', '3.5', '3.6', '3.1', '3.2'].flatMap((id) => places.get(id) ?? []);
  const chin = places.get('2.1') ?? places.get('2.10');
  if (eyes.length === 0 || !chin) return whole;
  const eye: Vec3 = [0, 0, 0];
  eyes.forEach((x, i) => (eye[i % 3]! += x / (eyes.length / 3)));
  const face = eye[1] - chin[1];
  if (!(face > 0)) return whole;

  const tall = (fit === 'head' ? crownAboveEyes : browAboveEyes) * face;
  // Hair and hats above the skull are part of the picture, as far as the model has them.
  const crown = fit === 'head' ? Math.max(tall, (places.get('11.5') ?? places.get('11.4') ?? eye)[1] - eye[1]) : tall;
  const top = Math.min(eye[1] + crown, max[1]);
  const bottom = Math.max(chin[1] - 0.06 * face, min[1]);
  const ears = ['10.1', '10.2', '10.7', '10.8', '10.9', '10.10'].flatMap((id) => places.get(id)?.[0] ?? []);
  const wide = Math.max(...ears.map((x) => Math.abs(x - eye[0])), (fit === 'head' ? halfWidth : 0.72) * face * 0.8);
  const half: Vec3 = [fit === 'head' ? wide * 1.06 : wide * 0.8, (top - bottom) / 2, halfDepth * face];
  // The head turns about its middle, which lies behind the eyes.
  return { centre: [eye[0], (top + bottom) / 2, eye[2] - 0.6 * face], half };
}

function boxOf(min: readonly number[], max: readonly number[]): Subject {
  const centre = min.map((low, i) => (low + max[i]!) / 2) as Vec3;
  const half = min.map((low, i) => Math.max((max[i]! - low) / 2, 1e-6)) as Vec3;
  return { centre, half };
}
