/** What a person has set in the Points tab for one head; it concerns this browser only. */
export interface PointSettings {
  /** Indices of the parts that are hidden. */
  hidden: readonly number[];
}

const none: PointSettings = { hidden: [] };
const prefix = 'semblante.points.';

/** Keeps the settings of each head in the browser. */
export class SettingsStore {
  constructor(private readonly storage: Storage | null) {}

  /** What is not understood is left out. */
  read(head: string): PointSettings {
    try {
      const kept = JSON.parse(this.storage?.getItem(prefix + head) ?? 'null') as Partial<Record<keyof PointSettings, unknown>> | null;
      const { hidden } = kept ?? {};
      return { hidden: Array.isArray(hidden) ? hidden.filter((part): part is number => Number.isSafeInteger(part) && part >= 0) : [] };
    } catch {
      return none;
    }
  }

  keep(head: string, settings: PointSettings): void {
    try {
      if (settings.hidden.length === 0) this.storage?.removeItem(prefix + head);
      else this.storage?.setItem(prefix + head, JSON.stringify(settings));
    } catch {
      return; // storage is full or forbidden: the settings last as long as the page
    }
  }

  forget(head: string): void {
    this.keep(head, none);
  }
}
