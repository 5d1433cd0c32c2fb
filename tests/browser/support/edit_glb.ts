import { readFileSync } from 'node:fs';

export interface Gltf {
  scenes: { nodes: number[] }[];
  nodes: object[];
  meshes: { name: string; primitives: { material?: number; indices?: number; attributes: Record<string, number> }[] }[];
  materials: object[];
  textures?: object[];
  images?: object[];
  accessors: { count: number }[];
  bufferViews: object[];
  buffers: { byteLength: number }[];
}

const padded = (bytes: Buffer, by: number): Buffer => Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4, by)]);

/** A GLB file to change: its document, and bytes to add to its buffer. */
export class EditedGlb {
  readonly gltf: Gltf;
  private binary: Buffer;

  constructor(path: string) {
    const file = readFileSync(path);
    const length = file.readUInt32LE(12);
    this.gltf = JSON.parse(file.toString('utf8', 20, 20 + length)) as Gltf;
    this.binary = padded(file.subarray(20 + length + 8), 0);
  }

  /** The number of the new buffer view. */
  addBytes(bytes: Uint8Array): number {
    this.gltf.bufferViews.push({ buffer: 0, byteOffset: this.binary.length, byteLength: bytes.length });
    this.binary = padded(Buffer.concat([this.binary, bytes]), 0);
    return this.gltf.bufferViews.length - 1;
  }

  /** The number of the new accessor. */
  addAccessor(array: Float32Array | Uint8Array | Uint16Array, type: string, count: number, more: object = {}): number {
    const componentType = array instanceof Float32Array ? 5126 : array instanceof Uint16Array ? 5123 : 5121;
    const bufferView = this.addBytes(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    const accessor = { bufferView, componentType, count, type, ...more };
    this.gltf.accessors.push(accessor);
    return this.gltf.accessors.length - 1;
  }

  bytes(): Uint8Array<ArrayBuffer> {
    this.gltf.buffers[0]!.byteLength = this.binary.length;
    const json = padded(Buffer.from(JSON.stringify(this.gltf)), 0x20);
    const word = (...values: number[]): Buffer => Buffer.from(Uint32Array.from(values).buffer);
    const [magic, asJson, asBinary] = [0x46546c67, 0x4e4f534a, 0x004e4942];
    return Buffer.concat([
      word(magic, 2, 28 + json.length + this.binary.length),
      word(json.length, asJson),
      json,
      word(this.binary.length, asBinary),
      this.binary,
    ]);
  }
}
