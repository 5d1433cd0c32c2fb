import { ApiError, problemFrom, unreachable } from './problem.ts';
import { noteAnswer } from './reach.ts';
import { loadServerWords, t } from '../words/words.ts';

export interface Answer<T> {
  value: T;
  etag: string | null;
  location: string | null;
}

export interface RequestOptions {
  method?: string;
  json?: unknown;
  body?: BodyInit;
  contentType?: string;
  headers?: Record<string, string>;
  signal?: AbortSignal;
  /** Whether the request is sent although its page closes. */
  keepalive?: boolean;
}

/** Of Retry-After as this server writes it; a date is none. */
function secondsOf(header: string | null): number | null {
  return header !== null && /^\d{1,3}$/.test(header) ? Number(header) : null;
}

async function send(path: string, options: RequestOptions): Promise<Response> {
  const headers = new Headers(options.headers);
  const init: RequestInit = { method: options.method ?? 'GET', headers };
  if (options.json !== undefined) {
    headers.set('Content-Type', 'application/json');
    init.body = JSON.stringify(options.json);
  } else if (options.body !== undefined) {
    // A form's type names its boundary, which the browser chooses.
    if (!(options.body instanceof FormData)) headers.set('Content-Type', options.contentType ?? 'application/octet-stream');
    init.body = options.body;
  }
  if (options.keepalive) init.keepalive = true;
  if (options.signal) init.signal = options.signal;
  let response: Response;
  try {
    response = await fetch(path, init);
  } catch (error) {
    if (error instanceof DOMException && error.name === 'AbortError') throw error;
    noteAnswer(null);
    throw new ApiError(unreachable());
  }
  noteAnswer(response);
  if (!response.ok) {
    const body = await response.text().catch(() => '');
    await loadServerWords();
    throw new ApiError(
      problemFrom(response.status, response.statusText, response.headers.get('Content-Type') ?? '', body),
      secondsOf(response.headers.get('Retry-After')),
    );
  }
  return response;
}

/** A request with a JSON response, or an empty one (204: `value` is undefined). Throws ApiError. */
export async function requestJson<T>(path: string, options: RequestOptions = {}): Promise<Answer<T>> {
  const response = await send(path, { ...options, headers: { Accept: 'application/json', ...options.headers } });
  const text = await response.text();
  const etag = response.headers.get('ETag');
  const location = response.headers.get('Location');
  if (text === '') return { value: undefined as T, etag, location };
  try {
    return { value: JSON.parse(text) as T, etag, location };
  } catch {
    throw new ApiError({
      type: 'about:blank',
      title: t('The server sent an answer that is not JSON'),
      status: response.status,
      detail: path,
    });
  }
}

/** A request for bytes to save as a file, as a Blob: browsers keep large Blobs on disk. */
export async function requestBlob(path: string, options: RequestOptions = {}): Promise<Blob> {
  return (await send(path, options)).blob();
}

/** Bytes of which no more than `most` are read; null: there are more, `read` of which have come. */
export async function requestBytesUpTo(path: string, most: number): Promise<{ bytes: Uint8Array | null; read: number }> {
  const { headers, body } = await send(path, {});
  const reader = body!.getReader();
  const pieces: Uint8Array[] = [];
  let read = 0;
  let goesOn = Number(headers.get('Content-Length')) <= most;
  while (goesOn) {
    const { done, value } = await reader.read();
    if (done) {
      const bytes = new Uint8Array(await new Blob(pieces as BlobPart[]).arrayBuffer());
      return { bytes, read };
    }
    pieces.push(value);
    read += value.byteLength;
    goesOn = read <= most;
  }
  await reader.cancel();
  return { bytes: null, read };
}

export async function requestBytes(path: string, signal?: AbortSignal): Promise<Uint8Array> {
  const response = await send(path, signal ? { signal } : {});
  return new Uint8Array(await response.arrayBuffer());
}
