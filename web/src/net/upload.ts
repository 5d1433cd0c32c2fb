import { ApiError, problemFrom, unreachable } from './problem.ts';
import { loadServerWords, t } from '../words/words.ts';

/** Uploads a file with XMLHttpRequest, which, unlike fetch, reports the progress (0..1). */
export function upload<T>(
  url: string,
  file: Blob,
  contentType: string,
  onProgress: (fraction: number) => void,
  signal?: AbortSignal,
): Promise<T> {
  return new Promise((resolve, reject) => {
    const request = new XMLHttpRequest();
    request.open('POST', url);
    request.setRequestHeader('Content-Type', contentType);
    request.setRequestHeader('Accept', 'application/json');
    request.upload.onprogress = (event) => {
      if (event.lengthComputable) onProgress(event.loaded / Math.max(event.total, 1));
    };
    request.onload = () => {
      const type = request.getResponseHeader('Content-Type') ?? '';
      if (request.status < 200 || request.status > 299) {
        const problem = problemFrom(request.status, request.statusText, type, request.responseText);
        void loadServerWords().then(() => reject(new ApiError(problem)));
        return;
      }
      try {
        resolve(JSON.parse(request.responseText) as T);
      } catch {
        reject(
          new ApiError({
            type: 'about:blank',
            title: t('The server sent an answer that is not JSON'),
            status: request.status,
          }),
        );
      }
    };
    request.onerror = () => reject(new ApiError(unreachable(t('The connection was lost during the upload.'))));
    request.onabort = () => reject(new DOMException(t('Upload cancelled'), 'AbortError'));
    signal?.addEventListener('abort', () => request.abort(), { once: true });
    request.send(file);
  });
}
