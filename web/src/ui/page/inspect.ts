import { neutralFrame } from '@client/index.ts';
import { deformNormals } from '@client/gpu/deform_reference.ts';
import { setExpression, setVisemes } from '../../face/frame.ts';
import { joinSeams, smoothNormals } from '@client/gpu/drawable_mesh.ts';
import { makeTangentTable } from '@client/gpu/tangent_table.ts';
import { readDeformed } from '../../view/deform_probe.ts';
import type { MicrophoneModel } from '../speak/microphone_model.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import type { LiveModel } from '../live/live_model.ts';
import type { SceneView } from '../stage/scene.ts';
import type { Studio } from '../shared/studio.ts';

interface Edit {
  viseme?: number;
  expression?: number;
  /** Quantized levels by FAP number. */
  faps?: Record<number, number>;
}

/** Exposes the page's state as `window.semblante` to tests and the developer console. The page does not use it. */
export function exposeInspection(
  scene: SceneView,
  studio: Studio,
  driver: FaceDriver,
  live: LiveModel,
  sound: HTMLAudioElement,
  microphone: MicrophoneModel,
): void {
  Object.assign(window, {
    semblante: { scene, studio, driver, live, sound, microphone, compareDeformation: (edit: Edit) => compareDeformation(scene, driver, edit) },
  });
}

/** Deforms one frame by shader and by kernel: differences of positions (diagonals) and normals (degrees). */
function compareDeformation(
  scene: SceneView,
  driver: FaceDriver,
  edit: Edit,
): { worstPosition: number; worstNormal: number; meanAgainstTriangles: number; moved: number } {
  const performer = scene.performer.value;
  const { face } = scene;
  if (!performer || !face) throw new Error('no face on the stage');
  const frame = neutralFrame();
  setVisemes(frame, edit.viseme ?? 0, 0, 1);
  if (edit.expression) setExpression(frame, edit.expression, 63);
  for (const [number, level] of Object.entries(edit.faps ?? {})) frame.levels[Number(number)] = level;
  driver.byHand();
  performer.follow(frame);
  for (let i = 0; i < 100; i += 1) performer.step(0.05, false);

  face.setPose(performer.pose);
  const shader = readDeformed(scene.stage.renderer, face);
  performer.kernel.deform(performer.poseNumber);
  const { positions } = performer.kernel;
  const normals = new Float32Array(positions.length);
  deformNormals(face.mesh, makeTangentTable(face.mesh), performer.pose, normals);
  const { mesh } = face;
  const seams = joinSeams(mesh.positions, mesh.normals);
  const restTriangles = smoothNormals(mesh.positions, mesh.indices, seams);
  const triangles = smoothNormals(positions, mesh.indices, seams);

  const diagonal = diagonalOf(mesh.positions);
  let worstPosition = 0;
  let worstNormal = 0;
  let moved = 0;
  let sum = 0;
  let counted = 0;
  for (let v = 0; v < mesh.vertexCount; v += 1) {
    worstPosition = Math.max(worstPosition, distance(shader.positions, positions, v) / diagonal);
    moved = Math.max(moved, distance(mesh.positions, positions, v) / diagonal);
    worstNormal = Math.max(worstNormal, angle(shader.normals, normals, v));
    // Skip vertices whose rest normal already differs from the triangles' normal (hard edges).
    if (angle(mesh.normals, restTriangles, v) > 3) continue;
    sum += angle(normals, triangles, v);
    counted += 1;
  }
  return { worstPosition, worstNormal, meanAgainstTriangles: sum / Math.max(counted, 1), moved };
}

const distance = (a: Float32Array, b: Float32Array, v: number): number =>
  Math.hypot(a[v * 3]! - b[v * 3]!, a[v * 3 + 1]! - b[v * 3 + 1]!, a[v * 3 + 2]! - b[v * 3 + 2]!);

/** Angle between two unit vectors, degrees, from the chord length, which is accurate at small angles. */
const angle = (a: Float32Array, b: Float32Array, v: number): number =>
  (2 * Math.asin(Math.min(1, distance(a, b, v) / 2)) * 180) / Math.PI;

function diagonalOf(positions: Float32Array): number {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  positions.forEach((value, i) => {
    low[i % 3] = Math.min(low[i % 3]!, value);
    high[i % 3] = Math.max(high[i % 3]!, value);
  });
  return Math.hypot(high[0]! - low[0]!, high[1]! - low[1]!, high[2]! - low[2]!);
}
