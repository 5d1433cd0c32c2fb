import { FaceError } from './face_error.ts';
import { errorLayout } from './generated/layouts.ts';

/** What every file of libsemblante has. Pointers and handles are numbers. */
export interface Memory {
  memory: { readonly buffer: ArrayBuffer };
  malloc(bytes: number): number;
  free(at: number): void;
  _initialize(): void;
}

/** The functions of libsemblante (clients/runtime/semblante.h) that every page calls. */
export interface Functions extends Memory {
  semblante_stream_create(options: number, stream: number, error: number): number;
  semblante_stream_destroy(stream: number): void;
  semblante_stream_start(stream: number, now: number): void;
  semblante_stream_stop(stream: number, now: number): void;
  semblante_stream_opened(stream: number, now: number): void;
  semblante_stream_receive(stream: number, bytes: number, size: number, now: number): number;
  semblante_stream_closed(stream: number, code: number, now: number): void;
  semblante_stream_tick(stream: number, now: number): void;
  semblante_stream_wake_time(stream: number): number;
  semblante_stream_take_bytes(stream: number, size: number): number;
  semblante_stream_next_event(stream: number, event: number): number;
  semblante_stream_frames(stream: number, count: number): number;
  semblante_stream_header(stream: number, header: number): number;
  semblante_stream_clock(stream: number, now: number, clock: number): number;
  semblante_stream_measure_clock(stream: number, now: number): void;
  semblante_stream_spoken(stream: number, state: number, speech: bigint, character: number, now: number): number;
  semblante_stream_set_captions(stream: number, on: number): number;
  semblante_stream_publish(stream: number, frames: number, count: number, mediaTime: number, now: number): number;
  semblante_stream_publish_sound(stream: number, packet: number, size: number, mediaTime: number): number;

  semblante_player_create(options: number, player: number, error: number): number;
  semblante_player_destroy(player: number): void;
  semblante_player_follow(player: number, stream: number): number;
  semblante_player_advance(player: number, now: number, elapsed: number): number;
  semblante_player_move_to(player: number, mediaTime: number): number;
  semblante_player_moment(player: number, moment: number): number;
  semblante_player_time(player: number): number;
  semblante_player_stats(player: number, statistics: number): number;
  semblante_player_clear(player: number): void;

  semblante_sha256(bytes: number, size: number, digest: number): number;

  semblante_evaluate(rig: number, frame: number, pose: number): void;
  semblante_interpolate(a: number, b: number, t: number, out: number): void;
  semblante_ease(before: number, from: number, to: number, after: number, spans: number, t: number, out: number): void;
  semblante_prepared_size(face: number): number;
  semblante_prepare_for(face: number, rig: number, memory: number): number;
  semblante_join_scratch(vertices: number): number;
  semblante_join_seams(vertices: number, positions: number, normals: number, scratch: number, joined: number): void;
  semblante_normals(triangles: number, positions: number, normals: number): void;
  semblante_rest_normals(triangles: number, positions: number, own: number, atRest: number): void;
  semblante_turn_normals(vertices: number, own: number, atRest: number, normals: number): void;
  semblante_deform_changed(face: number, before: number, now: number, positions: number): number;
}

/** What a fetch of the WebAssembly file gives, or its bytes. */
export type ModuleSource = Bytes | Response | Promise<Bytes | Response>;
type Bytes = ArrayBuffer | ArrayBufferView<ArrayBuffer>; // `BufferSource` and `WebAssembly` are names of pages' types alone

/** The error that a refusal of the library becomes: its result, the place and the words. */
export type Refusal = (result: number, where: string, message: string) => Error;

const refusedOptions: Refusal = (_, where, message) => new RangeError(`${where}: ${message}`);
const largestText = 4096;
const decoder = new TextDecoder();

/** A file of libsemblante in WebAssembly: an instance with its memory. One holds all faces, streams and players of a page. */
export class Runtime<Of extends Memory = Functions> {
  readonly functions: Of;
  private seen: ArrayBufferLike | null = null;
  private wholeBytes = new Uint8Array();
  private wholeView = new DataView(new ArrayBuffer(0));
  private readonly released = new FinalizationRegistry<Owned>(({ release, held }) => release(held));

  private static one: Runtime | null = null;
  private static loading: Promise<Runtime> | null = null;
  private static readonly waiting: ((runtime: Runtime) => void)[] = [];

  /** The page's instance: fetched, compiled and made once. After a failure the next call tries again. */
  static load(source: () => ModuleSource): Promise<Runtime> {
    Runtime.loading ??= Runtime.make(source());
    Runtime.loading.catch(() => (Runtime.loading = null));
    return Runtime.loading;
  }

  /** The page's instance; null before it is loaded. */
  static get loaded(): Runtime | null {
    return Runtime.one;
  }

  /** Calls `use` with the page's instance: now if it is loaded, else when it is. */
  static whenLoaded(use: (runtime: Runtime) => void): void {
    if (Runtime.one) use(Runtime.one);
    else Runtime.waiting.push(use);
  }

  private static async make(source: ModuleSource): Promise<Runtime> {
    Runtime.one = await Runtime.open(source);
    for (const use of Runtime.waiting.splice(0)) use(Runtime.one);
    return Runtime.one;
  }

  /** An instance of its own, of a file that has the functions `Of`. */
  static async open<Of extends Memory = Functions>(source: ModuleSource): Promise<Runtime<Of>> {
    const given = await source;
    if ('ok' in given && !given.ok) throw new FaceError('http', `${given.url}: status ${given.status}`, given.status);
    const bytes = 'arrayBuffer' in given ? await given.arrayBuffer() : given;
    const { instance } = await WebAssembly.instantiate(bytes, {});
    return new Runtime(instance.exports as unknown as Of);
  }

  private constructor(functions: Of) {
    this.functions = functions;
    functions._initialize();
  }

  /** The memory. A function that allocates may make it grow, and then an older view is empty: ask again. */
  get bytes(): Uint8Array {
    this.refresh();
    return this.wholeBytes;
  }

  get view(): DataView {
    this.refresh();
    return this.wholeView;
  }

  private refresh(): void {
    const { buffer } = this.functions.memory;
    if (buffer === this.seen) return;
    this.seen = buffer;
    this.wholeBytes = new Uint8Array(buffer);
    this.wholeView = new DataView(buffer);
  }

  /** Memory of zeros, to give back by `free`. Throws FaceError `memory`. */
  alloc(bytes: number): number {
    const at = this.functions.malloc(bytes) >>> 0;
    if (at === 0) throw new FaceError('memory', `cannot allocate ${bytes} bytes`);
    this.bytes.fill(0, at, at + bytes);
    return at;
  }

  free(at: number): void {
    this.functions.free(at);
  }

  /** A struct of `bytes` bytes whose first member says so. */
  struct(bytes: number): number {
    const at = this.alloc(bytes);
    this.view.setUint32(at, bytes, true);
    return at;
  }

  /**
   * The handle that `create` makes from options, a struct of `bytes` bytes that `fill` writes. Throws RangeError with the
   * library's place and words when it refuses them.
   */
  create(
    bytes: number,
    fill: (view: DataView, options: number) => void,
    create: (options: number, handle: number, error: number) => number,
  ): number {
    const options = this.struct(bytes);
    try {
      fill(this.view, options);
      return this.made((handle, error) => create(options, handle, error), refusedOptions);
    } finally {
      this.free(options);
    }
  }

  /** The handle that `make` writes. Throws what `refusal` makes of the library's words when it refuses. */
  made(make: (handle: number, error: number) => number, refusal: Refusal): number {
    const handle = this.alloc(4);
    try {
      this.attempt((error) => make(handle, error), refusal);
      return this.view.getUint32(handle, true);
    } finally {
      this.free(handle);
    }
  }

  /** Calls a function that gives a result and explains it by an error. Throws like `made`. */
  attempt(call: (error: number) => number, refusal: Refusal): void {
    const error = this.alloc(errorLayout.bytes);
    try {
      const result = call(error);
      if (result !== 0) throw refusal(result, this.text(error + errorLayout.where), this.text(error + errorLayout.message));
    } finally {
      this.free(error);
    }
  }

  /** A text that ends in zero; empty for null. */
  text(at: number): string {
    if (at === 0) return '';
    const { bytes } = this;
    const end = bytes.indexOf(0, at);
    return decoder.decode(bytes.slice(at, Math.min(end < 0 ? bytes.length : end, at + largestText)));
  }

  /** A whole number of 64 bits; exact up to 2^53. */
  wide(at: number): number {
    const { view } = this;
    return view.getUint32(at, true) + view.getUint32(at + 4, true) * 4294967296;
  }

  /**
   * Calls `release` with `held` when `owner` is forgotten without having been disposed of. Returns the function that does it now,
   * once. Neither may refer to `owner`, which would never be forgotten then. So `release` is a function of a module: a closure of
   * a method keeps whatever another closure of that method uses, `this` too.
   */
  owns<Held>(owner: object, release: (held: Held) => void, held: Held): () => void {
    const token = {};
    this.released.register(owner, { release, held }, token);
    let done = false;
    return () => {
      if (done) return;
      done = true;
      this.released.unregister(token);
      release(held);
    };
  }
}

interface Owned {
  release(held: unknown): void;
  held: unknown;
}

/** Blocks of the memory, for `owns`. */
export interface Blocks {
  readonly runtime: Pick<Memory, 'free'>;
  readonly blocks: readonly number[];
}

export function freeBlocks({ runtime, blocks }: Blocks): void {
  for (const at of blocks) runtime.free(at);
}
