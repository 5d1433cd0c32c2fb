import { loadFace, type Face, type LoadOptions } from '../face.ts';
import { FaceError } from '../face_error.ts';
import { ProtocolError } from '../../../protocol/ts/protocol_error.ts';
import { FaceTrouble, faceWords, type Trouble } from './words.ts';

/** Where a face comes from. */
export interface Source {
  /** the server's address, without a slash at its end */
  base: string;
  stream: string;
  /** null: the model that the stream shows */
  model: string | null;
  /** for a server that asks for tokens, from a page that is not its own */
  token: string | null;
}

export function requestOf(source: Source): typeof fetch {
  if (source.token === null) return fetch;
  const headers = { Authorization: `Bearer ${source.token}` };
  return (address, init) => fetch(address, { ...init, headers });
}

export function trouble(code: Trouble, name = ''): FaceTrouble {
  return new FaceTrouble(code, faceWords.trouble[code](name));
}

/** Characters of a text from a page that are shown in words. */
const shownLength = 80;

function shown(text: string): string {
  return text.length > shownLength ? `${text.slice(0, shownLength)}…` : text;
}

/**
 * The server that a page names: an address of http or https, or a path on the page's server; without a name the page's
 * server. Nothing else is requested. Throws FaceTrouble.
 */
export function serverOf(src: string, page: string): string {
  let url: URL;
  try {
    url = new URL(src === '' ? '/' : src, page);
  } catch {
    throw trouble('address', shown(src === '' ? page : src));
  }
  const isServer = (url.protocol === 'https:' || url.protocol === 'http:') && url.username + url.password + url.search + url.hash === '';
  if (!isServer) throw trouble('address', shown(src));
  return url.href.replace(/\/+$/, '');
}

/** Refuses what no id can be: half of a character, which no address can have. Throws FaceTrouble. */
export function expectIds(stream: string, model: string | null): void {
  const isText = (id: string): boolean => !/[\uD800-\uDFFF]/u.test(id);
  if (!isText(stream)) throw trouble('no-stream', shown(stream));
  if (model !== null && !isText(model)) throw trouble('model-unready');
}

/** Of an id that is not there, that no id can be (400), or that is longer than any (414, 431). */
const absentStatuses: ReadonlySet<number> = new Set([400, 404, 414, 431]);

/** What a status of the server means here. */
function troubleOf(status: number, absent: Trouble, name: string): FaceTrouble {
  if (status === 401 || status === 403) return trouble('private');
  return trouble(absentStatuses.has(status) ? absent : 'server', name);
}

/** What the page's developer was told already. */
const hinted = new Set<string>();

function hintOnce(words: string): void {
  if (hinted.has(words)) return;
  hinted.add(words);
  console.warn(`semblante-face: ${words}`);
}

/** To the page's developer, once a server: the browser does not tell a page a refused origin from a server that is down. */
function hintOrigin(base: string): void {
  const { origin } = location;
  if (new URL(base, location.href).origin === origin) return;
  hintOnce(`${base} cannot be reached, or refuses pages of another origin: semblante serve --allow-origin ${origin}`);
}

/** To the page's developer: which file a bundler has left behind, or that the page's Content-Security-Policy forbids WebAssembly. */
function hintLibrary(fault: unknown): void {
  hintOnce(fault instanceof Error ? fault.message : String(fault));
}

/** Where the page's Content-Security-Policy has refused a request to. */
const refusedOrigins = new Set<string>();
let isWatched = false;

function watchPolicy(): void {
  if (isWatched || typeof document === 'undefined') return;
  isWatched = true;
  document.addEventListener('securitypolicyviolation', ({ blockedURI, disposition, effectiveDirective }) => {
    if (disposition !== 'enforce' || effectiveDirective !== 'connect-src' || !blockedURI.startsWith('http')) return;
    refusedOrigins.add(new URL(blockedURI).origin);
  });
}

/** What a request without an answer has met: the page's own policy, or nothing. `addresses`: where it may have gone. */
async function troubleWithoutAnswer(addresses: readonly string[]): Promise<FaceTrouble> {
  await new Promise((wake) => setTimeout(wake)); // the browser tells of its policy in a task of its own
  const refused = refusedOrigins.size > 0 && addresses.map((address) => new URL(address, location.href).origin).find((origin) => refusedOrigins.has(origin));
  if (!refused) return trouble('unreachable');
  hintOnce(`the page's Content-Security-Policy needs ${refused} in connect-src`);
  return trouble('policy', refused);
}

/** The id of the model that a stream shows. Throws FaceTrouble. */
export async function modelOf(source: Source, signal: AbortSignal): Promise<string> {
  watchPolicy();
  const address = `${source.base}/v1/streams/${encodeURIComponent(source.stream)}`;
  const response = await requestOf(source)(address, { signal }).catch((error: unknown) => {
    if (signal.aborted) throw error;
    return troubleWithoutAnswer([source.base]);
  });
  if (response instanceof FaceTrouble) {
    if (response.code === 'unreachable') hintOrigin(source.base);
    throw response;
  }
  if (!response.ok) throw troubleOf(response.status, 'no-stream', shown(source.stream));
  const answer = (await response.json().catch((error: unknown) => {
    if (error instanceof SyntaxError) return null;
    throw signal.aborted ? error : trouble('unreachable');
  })) as { id?: unknown; model?: unknown } | null;
  if (typeof answer?.id !== 'string') {
    hintOnce(`${address} is answered, but by no Semblante server: src is its address, or a path that the page's server passes on to it`);
    throw trouble('unreachable');
  }
  const { model } = answer;
  if (source.model !== null) return source.model;
  if (typeof model !== 'string' || model === '') throw trouble('no-model', shown(source.stream));
  return model;
}

/** Faces that are being loaded: others on the page that begin meanwhile get the same. */
const loading = new Map<string, Promise<Face>>();

/**
 * Loads the face package. `images` begin to load as soon as rig.json names them. Throws FaceTrouble; what `signal` says when it is
 * aborted.
 */
export async function faceOf(
  source: Source,
  model: string,
  libraries: Pick<LoadOptions, 'draco' | 'runtime'>,
  level: NonNullable<LoadOptions['level']>,
  images: Images,
  signal: AbortSignal,
): Promise<Face> {
  const key = JSON.stringify([source.base, source.token, model, level]);
  for (let other = loading.get(key); other; other = loading.get(key)) {
    try {
      const face = await other;
      signal.throwIfAborted();
      return face;
    } catch (error) {
      signal.throwIfAborted();
      if (error instanceof FaceTrouble) throw error; // else the other face was taken off the page
    }
  }
  const face = loadFaceOf(source, model, libraries, level, images, signal);
  loading.set(key, face);
  try {
    return await face;
  } finally {
    if (loading.get(key) === face) loading.delete(key);
  }
}

async function loadFaceOf(
  source: Source,
  model: string,
  { draco, runtime }: Pick<LoadOptions, 'draco' | 'runtime'>,
  level: NonNullable<LoadOptions['level']>,
  images: Images,
  signal: AbortSignal,
): Promise<Face> {
  watchPolicy();
  const request = requestOf(source);
  const tapped: typeof fetch = (address, init) => {
    const response = request(address, init);
    if (String(address).includes('/rig.json')) response.then((rig) => images.prefetch(rig.clone()), () => undefined);
    return response;
  };
  try {
    return await loadFace(source.base, model, { draco, runtime, fetch: tapped, signal, level });
  } catch (error) {
    if (signal.aborted) throw error;
    if (error instanceof FaceError && error.code === 'http') throw troubleOf(error.status ?? 0, 'model-unready', '');
    if (error instanceof FaceError || error instanceof ProtocolError) throw trouble('damaged');
    // What a fetch without an answer throws, of the server or of the library's files.
    if (error instanceof TypeError || error instanceof DOMException)
      throw await troubleWithoutAnswer([source.base, import.meta.url]);
    hintLibrary(error);
    throw trouble('library');
  }
}

/** Bytes of images that are loaded before the first picture. */
const firstImageBytes = 48 * 1024;

/** The smallest images, up to `firstImageBytes` in all. */
export function smallImages<T extends { bytes: number }>(images: readonly T[]): T[] {
  let sum = 0;
  return [...images].sort((a, b) => a.bytes - b.bytes).filter(({ bytes }) => (sum += bytes) <= firstImageBytes);
}

/** The images that the first picture waits for: a face that stands still waits for all. */
export function firstImages<T extends { bytes: number }>(images: readonly T[], isStill: boolean): readonly T[] {
  return isStill ? images : smallImages(images);
}

/** Images of all faces of the page, as long as one has them, by address. */
const shared = new Map<string, WeakRef<Promise<ImageBitmap>>>();

/** Images by their hash, each fetched and decoded once; a face's levels of detail share them. */
export class Images {
  private readonly known = new Map<string, Promise<ImageBitmap>>();

  constructor(
    public source: Source,
    private readonly isStill: boolean,
  ) {}

  get(sha256: string): Promise<ImageBitmap> {
    let image = this.known.get(sha256);
    if (!image) {
      const { base, token } = this.source;
      const key = JSON.stringify([base, token, sha256]);
      image = shared.get(key)?.deref() ?? this.load(sha256);
      image.catch(() => {
        this.known.delete(sha256);
        shared.delete(key);
      });
      this.known.set(sha256, image);
      shared.set(key, new WeakRef(image));
    }
    return image;
  }

  /** Begins with the first images of a rig.json, such as eyes: a face without them looks wrong, not only plain. */
  prefetch(rigJson: Response): void {
    void rigJson.json().then(
      (rig: { images?: { sha256: string; bytes: number }[] }) => {
        for (const { sha256 } of firstImages(rig.images ?? [], this.isStill)) void this.get(sha256).catch(() => undefined);
      },
      () => undefined,
    );
  }

  private async load(sha256: string): Promise<ImageBitmap> {
    const response = await requestOf(this.source)(`${this.source.base}/v1/artefacts/${sha256}`);
    if (!response.ok) throw new Error(`image ${sha256}: status ${response.status}`);
    return createImageBitmap(await response.blob(), { colorSpaceConversion: 'none', premultiplyAlpha: 'none' });
  }
}
