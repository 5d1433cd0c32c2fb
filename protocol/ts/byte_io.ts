/** Little-endian numbers and LEB128 varints. */

/** A read past the end. The caller knows the field and converts this to a ProtocolError. */
export class EndOfBytes extends Error {}

/** A varint beyond 2^53 - 1, which no field allows. */
export class VarintTooLarge extends Error {}

export class ByteWriter {
  private bytes = new Uint8Array(256);
  private view = new DataView(this.bytes.buffer);
  private size = 0;

  u8(value: number): void {
    this.reserve(1);
    this.bytes[this.size++] = value;
  }

  varint(value: number): void {
    while (value >= 0x80) {
      this.u8((value % 0x80) | 0x80);
      value = Math.floor(value / 0x80);
    }
    this.u8(value);
  }

  f64(value: number): void {
    this.reserve(8);
    this.view.setFloat64(this.size, value, true);
    this.size += 8;
  }

  append(bytes: Uint8Array): void {
    this.reserve(bytes.length);
    this.bytes.set(bytes, this.size);
    this.size += bytes.length;
  }

  finish(): Uint8Array {
    return this.bytes.slice(0, this.size);
  }

  private reserve(more: number): void {
    if (this.size + more <= this.bytes.length) return;
    const grown = new Uint8Array(Math.max(this.bytes.length * 2, this.size + more));
    grown.set(this.bytes);
    this.bytes = grown;
    this.view = new DataView(grown.buffer);
  }
}

export class ByteReader {
  private readonly bytes: Uint8Array;
  private readonly view: DataView;
  private at = 0;

  constructor(bytes: Uint8Array) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  get remaining(): number {
    return this.bytes.length - this.at;
  }

  u8(): number {
    const byte = this.bytes[this.at];
    if (byte === undefined) throw new EndOfBytes();
    this.at += 1;
    return byte;
  }

  varint(): number {
    let value = 0;
    let scale = 1;
    for (let i = 0; i < 10; ++i) {
      const byte = this.u8();
      value += (byte & 0x7f) * scale;
      if (byte < 0x80) {
        if (value > Number.MAX_SAFE_INTEGER) throw new VarintTooLarge();
        return value;
      }
      scale *= 0x80;
    }
    throw new VarintTooLarge();
  }

  f64(): number {
    if (this.remaining < 8) throw new EndOfBytes();
    this.at += 8;
    return this.view.getFloat64(this.at - 8, true);
  }

  /** A view of the next bytes, not a copy. */
  take(count: number): Uint8Array {
    if (count > this.remaining) throw new EndOfBytes();
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }
}
