/** The arrays of a decoded mesh; null where the mesh has no such attribute. */
export interface DecodedMesh {
  positions: Float32Array;
  normals: Float32Array | null;
  uvs: Float32Array | null;
  /** #V: index into the rig's materials */
  materials: Uint8Array | null;
  indices: Uint32Array;
}

export interface MeshAttributes {
  position: number;
  normal: number | null;
  uv: number | null;
  material: number | null;
}

interface Waiting {
  resolve: (mesh: DecodedMesh) => void;
  reject: (error: Error) => void;
}

let worker: Worker | null = null;
let requests = 0;
const waiting = new Map<number, Waiting>();

function start(): Worker {
  const one = new Worker(new URL('./draco_worker.ts', import.meta.url));
  one.onmessage = (event: MessageEvent<{ number: number; result?: DecodedMesh; error?: string }>) => {
    const { number, result, error } = event.data;
    const entry = waiting.get(number);
    waiting.delete(number);
    if (result) entry?.resolve(result);
    else entry?.reject(new Error(error ?? 'the mesh cannot be decoded'));
  };
  one.onerror = (event) => {
    for (const entry of waiting.values()) entry.reject(new Error(`the Draco decoder failed: ${event.message}`));
    waiting.clear();
    worker = null;
  };
  return one;
}

/** Decodes mesh.drc in a worker. Rejects with what is wrong with the bytes. */
export function decodeMesh(bytes: Uint8Array, attributes: MeshAttributes): Promise<DecodedMesh> {
  worker ??= start();
  requests += 1;
  const number = requests;
  const base = new URL('./draco/', document.baseURI).href;
  return new Promise((resolve, reject) => {
    waiting.set(number, { resolve, reject });
    worker?.postMessage({ number, base, bytes, attributes });
  });
}
