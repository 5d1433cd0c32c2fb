// Runs in the page: deforms the golden face by the shader only.
import { WebGLRenderer } from 'three';
import type { Pose } from '@client/index.ts';
import type { DrawableMesh } from '@client/gpu/drawable_mesh.ts';
import { setPose } from '@client/three/deform_material.ts';
import { readDeformed } from '../../../web/src/view/deform_probe.ts';
import { FaceView } from '@client/three/face_view.ts';

export interface GoldenMesh {
  positions: number[];
  normals: number[];
  indices: number[];
  rowOffsets: number[];
  rowPoints: number[];
  rowWeights: number[];
  rigid: number[];
  turn: number[];
}

/** For each pose the vertices that the shader computes, #V by 3. */
function deformAll(given: GoldenMesh, poses: Record<keyof Pose, number[]>[]): number[][] {
  const mesh: DrawableMesh = {
    vertexCount: given.rigid.length,
    positions: Float32Array.from(given.positions),
    normals: Float32Array.from(given.normals),
    uvs: null,
    colors: null,
    indices: Uint32Array.from(given.indices),
    groups: [],
    rowOffsets: Uint32Array.from(given.rowOffsets),
    rowPoints: Uint8Array.from(given.rowPoints),
    rowWeights: Float32Array.from(given.rowWeights),
    rigid: Uint8Array.from(given.rigid),
    turn: Uint8Array.from(given.turn),
  };
  const view = new FaceView(mesh, []);
  const renderer = new WebGLRenderer();
  return poses.map((numbers) => {
    const pose = Object.fromEntries(Object.entries(numbers).map(([name, values]) => [name, Float32Array.from(values)]));
    setPose(view.uniforms, pose as unknown as Pose);
    return Array.from(readDeformed(renderer, view).positions);
  });
}

(window as unknown as { deformAll: typeof deformAll }).deformAll = deformAll;
