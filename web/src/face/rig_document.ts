import { featurePoints } from '@protocol/generated/mpeg4.ts';
import type { MeshAttributes } from './draco.ts';
import type { RigData } from './kernel.ts';

/** rig.json as the server writes it: what the studio reads of it. */
export interface RigDocument {
  format: 'semblante.rig';
  version: 1;
  name: string;
  mesh: { sha256: string; vertices: number; triangles: number; bytes: number; attributes: MeshAttributes };
  weights: { sha256: string; bytes: number };
  fapu: Record<'IRISD' | 'ES' | 'ENS' | 'MNS' | 'MW', number | null>;
  feature_points: { id: string; vertex: number | null; position: number[] }[];
  eye_pivots: [number[], number[]];
  head_pivot: number[];
  viseme_share: number;
  visemes: DisplacementSet[];
  expressions: DisplacementSet[];
  materials: RigMaterial[];
  images: { sha256: string; mime_type: string; bytes: number }[];
  warnings: string[];
}

export interface DisplacementSet {
  name: string;
  displacements: Record<string, number[]>;
}

export interface RigMaterial {
  name: string;
  base_color: [number, number, number, number];
  metallic: number;
  roughness: number;
  alpha_mode: 'opaque' | 'mask' | 'blend';
  alpha_cutoff: number;
  double_sided: boolean;
  base_color_image: string | null;
  normal_image: string | null;
}

/** Reads rig.json. Throws with the reason when it is none, or one of a version this page does not know. */
export function parseRig(text: string): RigDocument {
  const value = JSON.parse(text) as Partial<RigDocument>;
  if (value.format !== 'semblante.rig') throw new Error('rig.json is not a rig');
  if (value.version !== 1) throw new Error(`rig.json has version ${String(value.version)}; this page reads version 1`);
  if (!value.mesh || !value.fapu || value.visemes?.length !== 15 || value.expressions?.length !== 7) throw new Error('rig.json lacks a part');
  return value as RigDocument;
}

const indexOf = new Map(featurePoints.map((point, index) => [point.id, index]));

/** The displacement sets and pivots as the kernel takes them. */
export function rigData(rig: RigDocument): RigData {
  const { IRISD, ES, ENS, MNS, MW } = rig.fapu;
  return {
    visemes: packSets(rig.visemes),
    expressions: packSets(rig.expressions),
    fapu: [IRISD ?? 0, ES ?? 0, ENS ?? 0, MNS ?? 0, MW ?? 0],
    eyePivots: rig.eye_pivots,
    headPivot: rig.head_pivot,
    visemeShare: rig.viseme_share,
  };
}

/** #sets by 84 by 3. */
function packSets(sets: readonly DisplacementSet[]): Float32Array {
  const packed = new Float32Array(sets.length * 84 * 3);
  sets.forEach((set, number) => {
    for (const [id, displacement] of Object.entries(set.displacements)) {
      const point = indexOf.get(id);
      if (point === undefined) throw new Error(`rig.json moves ${id}, which is no feature point`);
      packed.set(displacement.slice(0, 3), (number * 84 + point) * 3);
    }
  });
  return packed;
}
