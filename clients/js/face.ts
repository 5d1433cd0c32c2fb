import { readRig, type RigDocument } from '../../protocol/ts/rig_document.ts';
import { decodeWeights, type InfluenceTable } from '../../protocol/ts/weights_format.ts';
import { decodeMesh, type DracoModule, type FaceMesh } from './draco_mesh.ts';
import { FaceError } from './face_error.ts';
import { sha256 } from './sha256.ts';

/** A face package, checked: the parts belong together and every index is within bounds. */
export interface Face {
  rig: RigDocument;
  mesh: FaceMesh;
  influence: InfluenceTable;
}

export interface LoadOptions {
  draco: DracoModule;
  /** Default: the platform's. */
  fetch?: typeof fetch;
  signal?: AbortSignal;
  /**
   * A level of detail: the largest of no more vertices (the smallest, when all have more), or by its number, 0 the full
   * mesh. `face.rig.levels` says which there are. Default: the full mesh.
   */
  level?: { maxVertices: number } | { lod: number };
}

/**
 * Fetches the package of a model from a server ("http://127.0.0.1:8080"). Throws FaceError or ProtocolError when a part
 * is missing, is not what it says, or does not belong to the others.
 */
export async function loadFace(baseUrl: string, modelId: string, options: LoadOptions): Promise<Face> {
  const folder = `${baseUrl.replace(/\/$/, '')}/v1/models/${encodeURIComponent(modelId)}`;
  try {
    return await fetchFace(folder, options);
  } catch (error) {
    // The package may have been replaced between two of the three requests: then all three are asked for once more.
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
      throw new FaceError('http', `${address} answers ${response.status} ${response.statusText}`, response.status);
    }
    return new Uint8Array(await response.arrayBuffer());
  };
  const [rig, weights, mesh] = await Promise.all([part('rig.json'), part('weights'), part('mesh.drc')]);
  return assembleFace(rig, weights, mesh, options.draco);
}

function levelQuery(level: LoadOptions['level']): string {
  if (!level) return '';
  return 'lod' in level ? `?lod=${level.lod}` : `?max_vertices=${level.maxVertices}`;
}

/** The same from bytes that are there already. */
export async function assembleFace(
  rigJson: Uint8Array,
  weights: Uint8Array,
  meshDrc: Uint8Array,
  draco: DracoModule,
): Promise<Face> {
  const rig = readRig(new TextDecoder().decode(rigJson));
  const [meshHash, weightsHash] = await Promise.all([sha256(meshDrc), sha256(weights)]);
  if (meshHash !== rig.mesh.sha256) throw new FaceError('mismatch', 'mesh.drc is not the mesh that rig.json names');
  if (weightsHash !== rig.weights.sha256) throw new FaceError('mismatch', 'weights are not those that rig.json names');
  const influence = await decodeWeights(weights);
  if (influence.meshSha256 !== meshHash) throw new FaceError('mismatch', 'the weights belong to another mesh');
  if (influence.vertexCount !== rig.mesh.vertices) {
    throw new FaceError('mismatch', `weights for ${influence.vertexCount} vertices, a mesh of ${rig.mesh.vertices}`);
  }
  return { rig, mesh: decodeMesh(draco, meshDrc, rig), influence };
}
