/**
 * Binary range coding with fixed probabilities: SPEC.md, "Range coder". A probability is that of a 1, in 4096ths. All
 * arithmetic is in integers below 2^53, so that every language produces the same bytes.
 */
export interface BitCoder {
  /** An encoder writes and returns `value`; a decoder ignores `value` and returns the decoded bit. */
  bit(probability: number, value: number): number;
  /** Codes the low `count` bits of `value`, high bits first, each with probability 1/2. */
  bits(count: number, value: number): number;
}

const least = 2 ** 24;
const whole = 2 ** 32;

export class RangeEncoder implements BitCoder {
  private readonly to: number[];
  private low = 0;
  private range = whole - 1;

  /** Appends to `to`; carries never change bytes before its current end. */
  constructor(to: number[]) {
    this.to = to;
  }

  bit(probability: number, value: number): number {
    const bound = (this.range >>> 12) * probability;
    if (value !== 0) {
      this.range = bound;
    } else {
      this.low += bound;
      this.range -= bound;
    }
    this.normalize();
    return value;
  }

  bits(count: number, value: number): number {
    for (let i = count - 1; i >= 0; i -= 1) {
      this.range >>>= 1;
      if (Math.floor(value / 2 ** i) % 2 === 1) this.low += this.range;
      this.normalize();
    }
    return value;
  }

  /** Writes the shortest end that decodes correctly when the decoder appends zeros. */
  finish(): void {
    for (let count = 0; count <= 4; count += 1) {
      const unit = 2 ** (32 - 8 * count);
      const value = Math.ceil(this.low / unit) * unit;
      if (value - this.low >= this.range) continue;
      this.low = value;
      for (let i = 0; i < count; i += 1) this.shift();
      this.carry();
      return;
    }
  }

  private normalize(): void {
    while (this.range < least) {
      this.shift();
      this.range *= 256;
    }
  }

  private carry(): void {
    if (this.low < whole) return;
    this.low -= whole;
    let at = this.to.length - 1;
    while (this.to[at] === 255) this.to[at--] = 0;
    this.to[at]! += 1;
  }

  private shift(): void {
    this.carry();
    this.to.push(Math.floor(this.low / least));
    this.low = (this.low % least) * 256;
  }
}

/** Decodes untrusted bytes. */
export class RangeDecoder implements BitCoder {
  private readonly bytes: Uint8Array;
  private at = 0;
  private code = 0;
  private range = whole - 1;
  /** Whether the first bytes can come from an encoder. */
  readonly valid: boolean;

  constructor(bytes: Uint8Array) {
    this.bytes = bytes;
    for (let i = 0; i < 4; i += 1) this.code = this.code * 256 + this.next();
    this.valid = this.code < this.range; // and stays so
  }

  bit(probability: number): number {
    const bound = (this.range >>> 12) * probability;
    const one = this.code < bound;
    if (one) {
      this.range = bound;
    } else {
      this.code -= bound;
      this.range -= bound;
    }
    this.normalize();
    return one ? 1 : 0;
  }

  bits(count: number): number {
    let value = 0;
    for (let i = 0; i < count; i += 1) {
      this.range >>>= 1;
      const one = this.code >= this.range;
      if (one) this.code -= this.range;
      value = 2 * value + (one ? 1 : 0);
      this.normalize();
    }
    return value;
  }

  /** Whether more than the four bytes that an encoder may omit were read past the end. */
  get truncated(): boolean {
    return this.at > this.bytes.length + 4;
  }

  /** Whether bytes remain that an encoder would not have written. */
  get hasMore(): boolean {
    return this.at < this.bytes.length;
  }

  private next(): number {
    const byte = this.bytes[this.at] ?? 0;
    this.at += 1;
    return byte;
  }

  private normalize(): void {
    while (this.range < least) {
      this.range *= 256;
      // Bounds an invalid code, which is refused at the end, to exact integers.
      this.code = (this.code * 256 + this.next()) % whole;
    }
  }
}
