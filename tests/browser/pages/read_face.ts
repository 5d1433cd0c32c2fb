import { Mesh, type MeshStandardMaterial } from 'three';
import { DRACOLoader } from 'three/addons/loaders/DRACOLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

export interface PrimitiveReport {
  vertices: number;
  triangles: number;
  attributes: string[];
  finite: boolean;
  highestIndex: number;
  highestPoint: number;
  highestSum: number;
  highestRigid: number;
}

export interface FaceReport {
  primitives: PrimitiveReport[];
  textures: number;
  /** `format` of the embedded rig. */
  format: string | null;
}

/** Loads face.glb as any three.js page would, without Semblante's code. */
export async function readFace(url: string, draco: string): Promise<FaceReport> {
  const loader = new GLTFLoader().setDRACOLoader(new DRACOLoader().setDecoderPath(draco));
  const gltf = await loader.loadAsync(url);
  const report: FaceReport = { primitives: [], textures: 0, format: null };
  gltf.scene.traverse((node) => {
    if (!(node instanceof Mesh)) return;
    if ((node.material as MeshStandardMaterial).map) report.textures += 1;
    report.primitives.push(describe(node));
  });
  report.format = findFormat(gltf.parser.json);
  return report;
}

function describe(mesh: Mesh): PrimitiveReport {
  const { geometry } = mesh;
  const position = geometry.getAttribute('position');
  const names = Object.keys(geometry.attributes);
  const index = geometry.getIndex()!;
  let highestIndex = 0;
  for (let i = 0; i < index.count; i += 1) highestIndex = Math.max(highestIndex, index.getX(i));
  const sums = new Float64Array(position.count);
  let highestPoint = 0;
  let highestRigid = 0;
  let finite = true;
  for (let v = 0; v < position.count; v += 1) {
    finite &&= Number.isFinite(position.getX(v) + position.getY(v) + position.getZ(v));
    highestRigid = Math.max(highestRigid, geometry.getAttribute('_rigid').getX(v));
    for (let set = 0; names.includes(`_fp_weight_${set}`); set += 1) {
      const weight = geometry.getAttribute(`_fp_weight_${set}`);
      const point = geometry.getAttribute(`_fp_index_${set}`);
      for (let k = 0; k < 4; k += 1) {
        sums[v]! += weight.getComponent(v, k);
        highestPoint = Math.max(highestPoint, point.getComponent(v, k));
      }
    }
  }
  return {
    vertices: position.count,
    triangles: index.count / 3,
    attributes: names,
    finite,
    highestIndex,
    highestPoint,
    highestSum: Math.max(...sums),
    highestRigid,
  };
}

function findFormat(json: unknown): string | null {
  if (typeof json !== 'object' || json === null) return null;
  const extension = (json as { extensions?: { SEMBLANTE_face?: { format?: string } } }).extensions?.SEMBLANTE_face;
  if (extension?.format) return extension.format;
  for (const value of Object.values(json)) {
    const found = findFormat(value);
    if (found) return found;
  }
  return null;
}
