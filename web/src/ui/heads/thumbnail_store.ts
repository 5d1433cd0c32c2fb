const database = 'semblante.thumbnails';
const table = 'pictures';

/**
 * Keeps the small pictures of heads in the browser by model id, so that the list has those of all heads that were opened here once. A
 * browser that keeps nothing has them as long as the page.
 */
export class ThumbnailStore {
  private opened: Promise<IDBDatabase | null> | null = null;

  /** Those that are kept; those of other heads than `heads` are deleted. */
  async read(heads: ReadonlySet<string>): Promise<Map<string, string>> {
    const found = new Map<string, string>();
    await this.work('readwrite', (pictures) => {
      const walk = pictures.openCursor();
      walk.onsuccess = () => {
        const { result: at } = walk;
        if (!at) return;
        const { key, value } = at as { key: unknown; value: unknown };
        if (typeof key === 'string' && typeof value === 'string' && heads.has(key)) found.set(key, value);
        else at.delete();
        at.continue();
      };
    });
    return found;
  }

  keep(head: string, picture: string): Promise<void> {
    return this.work('readwrite', (pictures) => void pictures.put(picture, head));
  }

  private async work(mode: IDBTransactionMode, act: (pictures: IDBObjectStore) => void): Promise<void> {
    const open = await (this.opened ??= openDatabase());
    if (!open) return;
    await new Promise<void>((done) => {
      try {
        const transaction = open.transaction(table, mode);
        transaction.oncomplete = transaction.onabort = () => done();
        act(transaction.objectStore(table));
      } catch {
        done(); // the browser has closed or emptied it
      }
    });
  }
}

function openDatabase(): Promise<IDBDatabase | null> {
  return new Promise((done) => {
    try {
      const request = indexedDB.open(database, 1);
      request.onupgradeneeded = () => void request.result.createObjectStore(table);
      request.onsuccess = () => {
        const { result } = request;
        result.onversionchange = () => result.close(); // someone signs out
        done(result);
      };
      request.onerror = request.onblocked = () => done(null);
    } catch {
      done(null); // forbidden
    }
  });
}

/** The next user of this browser may be another one. */
export function forgetThumbnails(): void {
  try {
    indexedDB.deleteDatabase(database);
  } catch {
    // A browser that keeps nothing.
  }
}
