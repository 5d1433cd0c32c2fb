const key = 'semblante.parametrizing';

/** Keeps which heads are being parametrized, for a page that is loaded again meanwhile: the id of the job by that of its head. */
export class JobStore {
  constructor(private readonly storage: Storage | null) {}

  /** What is not understood is left out. */
  read(): Map<string, string> {
    try {
      const kept = JSON.parse(this.storage?.getItem(key) ?? '{}') as Record<string, unknown>;
      return new Map(Object.entries(kept).filter((entry): entry is [string, string] => typeof entry[1] === 'string'));
    } catch {
      return new Map();
    }
  }

  keep(head: string, job: string): void {
    this.write(this.read().set(head, job));
  }

  forget(head: string): void {
    const jobs = this.read();
    if (jobs.delete(head)) this.write(jobs);
  }

  private write(jobs: ReadonlyMap<string, string>): void {
    try {
      this.storage?.setItem(key, JSON.stringify(Object.fromEntries(jobs)));
    } catch {
      return; // storage is full or forbidden: a page that is loaded again does not know of the job
    }
  }
}
