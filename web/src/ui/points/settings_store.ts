import { pointById } from '../../face/feature_points.ts';

/** What a person has set in the Points tab for one head; it concerns this browser only. */
export interface PointSettings {
  /** Indices of the parts that are hidden. */
  hidden: readonly number[];
  /** Whether left and right points move together. */
  locked: boolean;
  /** The pairs that do not, by their first point. */
  apart: readonly string[];
}

const none: PointSettings = { hidden: [], locked: false, apart: [] };
const prefix = 'semblante.points.';

/** Keeps the settings of each head in the browser. */
export class SettingsStore {
  constructor(private readonly storage: Storage | null) {}

  /** What is not understood is left out. */
  read(head: string): PointSettings {
    try {
      const kept = JSON.parse(this.storage?.getItem(prefix + head) ?? 'null') as Partial<Record<keyof PointSettings, unknown>> | null;
      const { hidden, locked, apart } = kept ?? {};
      return {
        hidden: listOf(hidden, (part): part is number => Number.isSafeInteger(part) && (part as number) >= 0),
        locked: locked === true,
        apart: listOf(apart, (id): id is string => typeof id === 'string' && pointById(id) !== undefined),
      };
    } catch {
      return none;
    }
  }

  change(head: string, change: Partial<PointSettings>): void {
    const settings = { ...this.read(head), ...change };
    try {
      if (settings.hidden.length === 0 && !settings.locked && settings.apart.length === 0) this.forget(head);
      else this.storage?.setItem(prefix + head, JSON.stringify(settings));
    } catch {
      return; // storage is full or forbidden: the settings last as long as the page
    }
  }

  forget(head: string): void {
    this.storage?.removeItem(prefix + head);
  }
}

const listOf = <T>(list: unknown, qualifies: (one: unknown) => one is T): T[] => (Array.isArray(list) ? list.filter(qualifies) : []);
