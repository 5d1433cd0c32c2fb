/* Decodes Draco away from the page's thread. A classic script without imports: it loads the decoder by importScripts. */

interface DracoArray {
  GetValue(index: number): number;
}
interface DracoModule {
  HEAPU8: Uint8Array;
  HEAPF32: Float32Array;
  DT_FLOAT32: number;
  DT_UINT8: number;
  _malloc(bytes: number): number;
  _free(at: number): void;
  Decoder: new () => {
    DecodeArrayToMesh(bytes: Int8Array, length: number, mesh: DracoMesh): { ok(): boolean; error_msg(): string; ptr: number };
    GetAttributeByUniqueId(mesh: DracoMesh, id: number): { num_components(): number; ptr: number };
    GetAttributeDataArrayForAllPoints(mesh: DracoMesh, attribute: unknown, type: number, bytes: number, at: number): boolean;
    GetTrianglesUInt32Array(mesh: DracoMesh, bytes: number, at: number): boolean;
  };
  Mesh: new () => DracoMesh;
  destroy(thing: unknown): void;
}
interface DracoMesh {
  num_points(): number;
  num_faces(): number;
}
interface DracoRequest {
  number: number;
  base: string;
  bytes: Uint8Array;
  /** Draco's unique ids; null: the mesh has none. */
  attributes: { position: number; normal: number | null; uv: number | null; material: number | null };
}

let draco: Promise<DracoModule> | null = null;

function loadDraco(base: string): Promise<DracoModule> {
  const scope = self as unknown as { importScripts(url: string): void; DracoDecoderModule(options: object): Promise<DracoModule> };
  scope.importScripts(`${base}draco_wasm_wrapper.js`);
  return scope.DracoDecoderModule({ locateFile: () => `${base}draco_decoder.wasm` });
}

function decodeDraco(module: DracoModule, { bytes, attributes }: DracoRequest): Record<string, Float32Array | Uint32Array | Uint8Array | null> {
  const decoder = new module.Decoder();
  const mesh = new module.Mesh();
  try {
    const status = decoder.DecodeArrayToMesh(new Int8Array(bytes.buffer, bytes.byteOffset, bytes.byteLength), bytes.byteLength, mesh);
    if (!status.ok()) throw new Error(`the mesh cannot be decoded: ${status.error_msg()}`);
    const points = mesh.num_points();
    const copy = (size: number, fill: (at: number) => boolean): Uint8Array => {
      const at = module._malloc(size);
      if (!fill(at)) throw new Error('the mesh lacks an attribute that its rig names');
      const out = module.HEAPU8.slice(at, at + size);
      module._free(at);
      return out;
    };
    const floats = (id: number | null, components: number): Float32Array | null => {
      if (id === null) return null;
      const attribute = decoder.GetAttributeByUniqueId(mesh, id);
      if (attribute.num_components() !== components) throw new Error(`attribute ${id} has ${attribute.num_components()} components, not ${components}`);
      const size = points * components * 4;
      return new Float32Array(copy(size, (at) => decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, module.DT_FLOAT32, size, at)).buffer);
    };
    const material = attributes.material;
    const triangleBytes = mesh.num_faces() * 12;
    return {
      positions: floats(attributes.position, 3),
      normals: floats(attributes.normal, 3),
      uvs: floats(attributes.uv, 2),
      materials: material === null ? null : copy(points, (at) => decoder.GetAttributeDataArrayForAllPoints(mesh, decoder.GetAttributeByUniqueId(mesh, material), module.DT_UINT8, points, at)),
      indices: new Uint32Array(copy(triangleBytes, (at) => decoder.GetTrianglesUInt32Array(mesh, triangleBytes, at)).buffer),
    };
  } finally {
    module.destroy(mesh);
    module.destroy(decoder);
  }
}

self.onmessage = (event: MessageEvent<DracoRequest>): void => {
  const { number, base } = event.data;
  draco ??= loadDraco(base);
  draco.then(
    (module) => {
      try {
        const result = decodeDraco(module, event.data);
        const transfer = Object.values(result).flatMap((array) => (array ? [array.buffer] : []));
        self.postMessage({ number, result }, { transfer });
      } catch (error) {
        self.postMessage({ number, error: error instanceof Error ? error.message : String(error) });
      }
    },
    (error: unknown) => self.postMessage({ number, error: `the Draco decoder did not start: ${String(error)}` }),
  );
};
