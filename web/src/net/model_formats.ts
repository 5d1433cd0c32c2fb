import { language } from '../words/words.ts';
import type { operations } from './generated/api.ts';

type UploadMediaType = keyof operations['createModel']['requestBody']['content'];

interface ModelFormat {
  extension: string;
  mediaType: UploadMediaType;
  title: string;
}

/** The model formats that the server imports. A test compares this list with `model_files` of core/import/model_formats.h. */
export const modelFormats: readonly ModelFormat[] = [
  { extension: '.glb', mediaType: 'model/gltf-binary', title: 'GLB' },
  { extension: '.vrm', mediaType: 'model/gltf-binary', title: 'VRM' },
  { extension: '.gltf', mediaType: 'model/gltf+json', title: 'glTF' },
  { extension: '.obj', mediaType: 'model/obj', title: 'OBJ' },
  { extension: '.ply', mediaType: 'model/ply', title: 'PLY' },
  { extension: '.stl', mediaType: 'model/stl', title: 'STL' },
  { extension: '.zip', mediaType: 'application/zip', title: 'ZIP' },
];

const titles = modelFormats.map(({ title }) => title);

/** All formats as a list: "GLB, VRM, glTF, ...". */
export const formatList = titles.join(', ');

/** All formats as alternatives: "GLB, VRM, ..., or OBJ", in Portuguese "ou OBJ". */
export const anyFormat = new Intl.ListFormat(language, { type: 'disjunction' }).format(titles);

/** The media type by the extension of the file name; the server decides by the content. */
export function mediaTypeOf(fileName: string): UploadMediaType {
  const name = fileName.toLowerCase();
  return modelFormats.find(({ extension }) => name.endsWith(extension))?.mediaType ?? 'application/octet-stream';
}
