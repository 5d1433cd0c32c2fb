import type { operations } from './generated/api.ts';

type UploadMediaType = keyof operations['createModel']['requestBody']['content'];

interface ModelFormat {
  extension: string;
  mediaType: UploadMediaType;
  title: string;
}

/** The files of heads that the server reads: `model_files` of core/import/model_formats.h, which a test compares. */
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

/** "GLB, VRM, glTF" and so on. */
export const formatList = titles.join(', ');

/** "GLB, VRM, glTF" and so on, with "or" before the last. */
export const anyFormat = `${titles.slice(0, -1).join(', ')} or ${titles.at(-1)}`;

/** For the `accept` of a file input. */
export const acceptedFiles = modelFormats.map(({ extension }) => extension).join(',');

/** By the extension of the name; the server goes by the content. */
export function mediaTypeOf(fileName: string): UploadMediaType {
  const name = fileName.toLowerCase();
  return modelFormats.find(({ extension }) => name.endsWith(extension))?.mediaType ?? 'application/octet-stream';
}
