import { mediaTypeOf, modelFormats } from './model_formats.ts';

/** A file with its path in what was chosen or dropped: "head.obj", or "avatar/textures/skin.png" of a folder. */
export interface PathFile {
  path: string;
  file: File;
}

/** What a glTF or OBJ refers to: buffers, material files, images. */
const resourceEndings = ['.bin', '.mtl', '.png', '.jpg', '.jpeg', '.webp', '.ktx2', '.bmp', '.tga', '.gif', '.tif', '.tiff'];

const modelEndings = modelFormats.map(({ extension }) => extension);

/** The endings of model files and of the files that they refer to, for the `accept` attribute of a file input. */
export const headFileEndings = [...modelEndings, ...resourceEndings].join(',');

const endsWithOneOf = (path: string, endings: readonly string[]): boolean => endings.some((ending) => path.toLowerCase().endsWith(ending));

const folderOf = (path: string): string => path.slice(0, path.lastIndexOf('/') + 1);

/**
 * The uploads for these files, one for each model. A glTF or OBJ that came with other files becomes a zip with them, because
 * the server accepts one file for a head: with all of them if it is the only such model, else with those in its folder and
 * below it. Other files (a licence in a folder) are left out, unless there is no model by name: then the server decides by content.
 */
export async function headUploads(files: readonly PathFile[]): Promise<File[]> {
  const resources = files.filter(({ path }) => endsWithOneOf(path, resourceEndings));
  const models = files.filter(({ path }) => endsWithOneOf(path, modelEndings));
  const needy = models.filter(({ path }) => endsWithOneOf(path, ['.gltf', '.obj']));
  if (models.length === 0) return files.map(({ file }) => file);
  return Promise.all(
    models.map(async (model) => {
      if (!needy.includes(model)) return model.file;
      const own = needy.length === 1 ? resources : resources.filter(({ path }) => path.startsWith(folderOf(model.path)));
      return own.length > 0 ? zipOf(model, own) : model.file;
    }),
  );
}

/** A zip without compression: images gain nothing by it, and the page would stand still meanwhile. */
async function zipOf(model: PathFile, others: readonly PathFile[]): Promise<File> {
  const { zipSync } = await import('fflate');
  const entries: Record<string, Uint8Array> = {};
  for (const { path, file } of [model, ...others]) entries[path] = new Uint8Array(await file.arrayBuffer());
  const name = model.file.name.replace(/\.[a-z0-9]+$/i, '.zip');
  return new File([zipSync(entries, { level: 0 }).buffer as ArrayBuffer], name, { type: mediaTypeOf(name) });
}
