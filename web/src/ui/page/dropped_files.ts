import type { PathFile } from '../../net/head_files.ts';

/** Limits what a dropped folder is read for: a home folder dropped by mistake must not hang the page. */
const mostFiles = 1000;

/** The dropped files, those in dropped folders too. To be called in the event handler: the transfer is empty afterwards. */
export async function droppedFiles(transfer: DataTransfer): Promise<PathFile[]> {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry());
  const plain = [...transfer.files].map((file) => ({ path: file.name, file }));
  if (!entries.some((entry) => entry?.isDirectory)) return plain;
  const found: PathFile[] = [];
  for (const entry of entries) if (entry) await collect(entry, found);
  return found;
}

async function collect(entry: FileSystemEntry, found: PathFile[]): Promise<void> {
  if (found.length >= mostFiles || entry.name.startsWith('.') || entry.name === '__MACOSX') return;
  if (entry.isFile) {
    const file = await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject));
    found.push({ path: entry.fullPath.replace(/^\//, ''), file });
    return;
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  // A reader returns the entries in portions (100 in Chromium); an empty portion is the end.
  for (;;) {
    const portion = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (portion.length === 0) return;
    for (const child of portion) await collect(child, found);
  }
}
