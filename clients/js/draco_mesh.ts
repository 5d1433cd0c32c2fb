import type { RigDocument } from '../../protocol/ts/rig_document.ts';
import { FaceError } from './face_error.ts';

/**
 * The used part of a Draco decoder module, as `createDecoderModule()` of npm's draco3d or `DracoDecoderModule()` of
 * three.js's draco_wasm_wrapper.js resolve to. The caller passes the module, so that a page loads it only once.
 */
export interface DracoModule {
  Decoder: new () => DracoDecoder;
  DecoderBuffer: new () => DracoBuffer;
  Mesh: new () => DracoMesh;
  readonly TRIANGULAR_MESH: number;
  readonly DT_FLOAT32: number;
  readonly DT_UINT8: number;
  readonly DT_UINT32: number;
  readonly HEAPU8: Uint8Array;
  _malloc(bytes: number): number;
  _free(pointer: number): void;
  destroy(object: unknown): void;
}
interface DracoBuffer {
  Init(bytes: Int8Array, length: number): void;
}
interface DracoMesh {
  num_points(): number;
  num_faces(): number;
}
interface DracoAttribute {
  ptr: number;
  num_components(): number;
}
interface DracoDecoder {
  GetEncodedGeometryType(buffer: DracoBuffer): number;
  DecodeBufferToMesh(buffer: DracoBuffer, mesh: DracoMesh): { ok(): boolean; error_msg(): string };
  GetAttributeByUniqueId(mesh: DracoMesh, id: number): DracoAttribute;
  GetAttributeDataArrayForAllPoints(
    mesh: DracoMesh,
    attribute: DracoAttribute,
    type: number,
    bytes: number,
    pointer: number,
  ): boolean;
  GetTrianglesUInt32Array(mesh: DracoMesh, bytes: number, pointer: number): boolean;
}

/** The decoded neutral face, in the vertex order of the weights. */
export interface FaceMesh {
  /** #V by 3, model units */
  positions: Float32Array;
  /** #V by 3, or null */
  normals: Float32Array | null;
  /** #V by 2, or null */
  uvs: Float32Array | null;
  /** #V by 3: sRGB, multiplied with the look of the material as linear light; or null */
  colors: Uint8Array | null;
  /** #V: index into the rig's materials; null: all vertices have the first material */
  materials: Uint8Array | null;
  /** #V: number of the vertex in the model's file, or null */
  fileVertices: Uint32Array | null;
  /** #T by 3 */
  triangles: Uint32Array;
}

/** Decodes mesh.drc. Throws FaceError when the mesh is malformed or does not match the rig. */
export function decodeMesh(draco: DracoModule, bytes: Uint8Array, rig: RigDocument): FaceMesh {
  const decoder = new draco.Decoder();
  const buffer = new draco.DecoderBuffer();
  const mesh = new draco.Mesh();
  try {
    buffer.Init(new Int8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength), bytes.byteLength);
    if (decoder.GetEncodedGeometryType(buffer) !== draco.TRIANGULAR_MESH) {
      throw new FaceError('malformed', 'mesh.drc is not a triangle mesh');
    }
    const status = decoder.DecodeBufferToMesh(buffer, mesh);
    if (!status.ok()) throw new FaceError('malformed', `mesh.drc: ${status.error_msg()}`);
    const vertices = mesh.num_points();
    const triangles = mesh.num_faces();
    if (vertices !== rig.mesh.vertices || triangles !== rig.mesh.triangles) {
      throw new FaceError('mismatch', `mesh.drc has ${vertices} vertices, rig.json declares ${rig.mesh.vertices}`);
    }

    const read = (type: number, count: number, fill: (size: number, at: number) => boolean): Uint8Array => {
      const size = count * (type === draco.DT_UINT8 ? 1 : 4);
      const at = draco._malloc(size);
      try {
        if (at === 0 || !fill(size, at)) throw new FaceError('malformed', 'mesh.drc: an attribute cannot be decoded');
        return draco.HEAPU8.slice(at, at + size);
      } finally {
        draco._free(at);
      }
    };
    const attribute = (name: string, id: number | null, type: number, components: number): ArrayBuffer | null => {
      if (id === null) return null;
      const found = decoder.GetAttributeByUniqueId(mesh, id);
      if (found.ptr === 0 || found.num_components() !== components) {
        throw new FaceError('malformed', `mesh.drc: no attribute ${id} with ${components} components for ${name}`);
      }
      return read(type, vertices * components, (size, at) =>
        decoder.GetAttributeDataArrayForAllPoints(mesh, found, type, size, at),
      ).buffer as ArrayBuffer;
    };

    const { attributes } = rig.mesh;
    const normals = attribute('normals', attributes.normal, draco.DT_FLOAT32, 3);
    const uvs = attribute('UVs', attributes.uv, draco.DT_FLOAT32, 2);
    const colors = attribute('colours', attributes.color, draco.DT_UINT8, 3);
    const materials = attribute('materials', attributes.material, draco.DT_UINT8, 1);
    const fileVertices = attribute('file vertices', attributes.file_vertex, draco.DT_UINT32, 1);
    const result: FaceMesh = {
      positions: new Float32Array(attribute('positions', attributes.position, draco.DT_FLOAT32, 3)!),
      normals: normals && new Float32Array(normals),
      uvs: uvs && new Float32Array(uvs),
      colors: colors && new Uint8Array(colors),
      materials: materials && new Uint8Array(materials),
      fileVertices: fileVertices && new Uint32Array(fileVertices),
      triangles: new Uint32Array(
        read(draco.DT_UINT32, triangles * 3, (size, at) => decoder.GetTrianglesUInt32Array(mesh, size, at)).buffer,
      ),
    };
    checkMesh(result, vertices, rig.materials.length);
    return result;
  } finally {
    draco.destroy(mesh);
    draco.destroy(buffer);
    draco.destroy(decoder);
  }
}

function checkMesh(mesh: FaceMesh, vertices: number, materialCount: number): void {
  for (const corner of mesh.triangles) {
    if (corner >= vertices) throw new FaceError('out_of_range', `mesh.drc: a triangle has vertex ${corner}`);
  }
  for (const material of mesh.materials ?? []) {
    if (material >= materialCount) throw new FaceError('out_of_range', `mesh.drc: a vertex has material ${material}`);
  }
  for (const coordinate of mesh.positions) {
    if (!Number.isFinite(coordinate)) throw new FaceError('not_finite', 'mesh.drc: a position is not finite');
  }
}
