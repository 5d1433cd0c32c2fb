import { readRig, type RigDocument } from '../../protocol/ts/rig_document.ts';
import { decodeWeights, type InfluenceTable } from '../../protocol/ts/weights_format.ts';
import { decodeMesh, type DracoModule, type FaceMesh } from './draco_mesh.ts';
import { FaceError } from './face_error.ts';
import type { Runtime } from './runtime.ts';
import { sha256 } from './sha256.ts';

/** A validated face package: its parts match each other and all indices are within bounds. */
export interface Face {
  rig: RigDocument;
  mesh: FaceMesh;
  influence: InfluenceTable;
}

export interface LoadOptions {
  /** Or promises of them: the parts are requested meanwhile. */
  draco: DracoModule | Promise<DracoModule>;
  runtime: Runtime | Promise<Runtime>;
  /** Default: the platform's fetch. */
  fetch?: typeof fetch;
  signal?: AbortSignal;
  /**
   * The level of detail: the largest with at most `maxVertices` (else the smallest), or by number (0 is the full mesh).
   * `face.rig.levels` lists the available levels. Default: the full mesh.
   */
  level?: { maxVertices: number } | { lod: number };
}

/**
 * Fetches the face package of a model from a server ("http://127.0.0.1:8080"). Throws FaceError or ProtocolError when a
 * part is missing, malformed, or does not match the others.
 */
export async function loadFace(baseUrl: string, modelId: string, options: LoadOptions): Promise<Face> {
  const folder = `${baseUrl.replace(/\/$/, '')}/v1/models/${encodeURIComponent(modelId)}`;
  try {
    return await fetchFace(folder, options);
  } catch (error) {
    // A mismatch may mean that the package was replaced between the three requests: repeat all three once.
    if (error instanceof FaceError && error.code === 'mismatch') return fetchFace(folder, options);
    throw error;
  }
}

async function fetchFace(folder: string, options: LoadOptions): Promise<Face> {
  const load = options.fetch ?? fetch;
  const part = async (name: string): Promise<Uint8Array> => {
    const address = `${folder}/${name}${levelQuery(options.level)}`;
    const response = await load(address, options.signal ? { signal: options.signal } : {});
    if (!response.ok) {
      throw new FaceError('http', `${address}: status ${response.status} ${response.statusText}`, response.status);
    }
    return new Uint8Array(await response.arrayBuffer());
  };
  const [rig, weights, mesh] = await Promise.all([part('rig.json'), part('weights'), part('mesh.drc')]);
  return assembleFace(rig, weights, mesh, await options.draco, await options.runtime);
}

function levelQuery(level: LoadOptions['level']): string {
  if (!level) return '';
  return 'lod' in level ? `?lod=${level.lod}` : `?max_vertices=${level.maxVertices}`;
}

/** Assembles a face from the bytes of its parts. Throws like `loadFace`. */
export async function assembleFace(
  rigJson: Uint8Array,
  weights: Uint8Array,
  meshDrc: Uint8Array,
  draco: DracoModule,
  runtime: Runtime,
): Promise<Face> {
  const rig = readRig(new TextDecoder().decode(rigJson));
  const meshHash = sha256(runtime, meshDrc);
  if (meshHash !== rig.mesh.sha256) throw new FaceError('mismatch', 'the SHA-256 of mesh.drc differs from rig.json');
  if (sha256(runtime, weights) !== rig.weights.sha256) {
    throw new FaceError('mismatch', 'the SHA-256 of the weights differs from rig.json');
  }
  const influence = await decodeWeights(weights);
  if (influence.meshSha256 !== meshHash) throw new FaceError('mismatch', 'the weights belong to another mesh');
  if (influence.vertexCount !== rig.mesh.vertices) {
    throw new FaceError('mismatch', `the weights have ${influence.vertexCount} vertices, the mesh ${rig.mesh.vertices}`);
  }
  return { rig, mesh: decodeMesh(draco, meshDrc, rig), influence };
}
