import type { Api } from '../net/api.ts';
import type { Model } from '../net/types.ts';
import type { LoadedFace } from './loaded_face.ts';

export function loadFace(_api: Api, _model: Model, _signal: AbortSignal): Promise<LoadedFace> {
  return Promise.reject(new Error('not yet'));
}
