import { problemOf, wordsOf } from '../../net/problem.ts';
import { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';
import { slotOfFile, slots } from './slot_names.ts';
import { t } from '../../words/words.ts';

/** A file with the mesh of the open head in another shape, and the viseme or expression that it is to become. */
export interface Scan {
  file: File;
  slot: string | null;
  /** Why it gave none; null: it was not tried, or it did. */
  fault: string | null;
}

/**
 * A viseme from a scan has to move the mouth alone: whatever moves by fewer units of a FAP than this stays with the expression that
 * is shown with it (Eq. 5).
 */
const leastOfViseme = 50;

/** Makes scans of the open head in expressions to its own expressions. */
export class ScansModel {
  readonly scans = new Signal<readonly Scan[]>([]);
  readonly busy = new Signal(false);

  constructor(private readonly studio: Studio) {
    let head: string | null = null;
    studio.selected.watch((model) => {
      const id = model?.id ?? null;
      if (id !== head) this.scans.set([]);
      head = id;
    });
  }

  /** Takes files; each gets the place that its name tells, unless another one has it. */
  add(files: readonly File[]): void {
    const scans = [...this.scans.value];
    for (const file of files) {
      const slot = slotOfFile(file.name);
      scans.push({ file, slot: scans.some((scan) => scan.slot === slot) ? null : slot, fault: null });
    }
    this.scans.set(scans);
  }

  remove(scan: Scan): void {
    this.scans.set(this.scans.value.filter((one) => one !== scan));
  }

  /** Gives a scan its place, which no other one keeps. */
  place(scan: Scan, slot: string | null): void {
    this.scans.set(
      this.scans.value.map((one) => {
        if (one === scan) return { ...one, slot, fault: null };
        return slot !== null && one.slot === slot ? { ...one, slot: null } : one;
      }),
    );
  }

  /** The scans that have a place. */
  get placed(): readonly Scan[] {
    return this.scans.value.filter(({ slot }) => slot !== null);
  }

  /** Reads the placed scans and has the head wear what they give; those that give nothing stay in the list with the reason. */
  async wear(): Promise<void> {
    const { studio } = this;
    const model = studio.selected.value;
    if (!model || this.busy.value) return;
    this.busy.set(true);
    const worn: Record<string, string> = {};
    for (const scan of this.placed) {
      const slot = slots.find(({ name }) => name === scan.slot)!;
      try {
        const set = await studio.readExpression(model, scan.file, {
          kind: slot.kind,
          align: true,
          ...(slot.kind === 'viseme' ? { least: leastOfViseme } : {}),
        });
        if (set === null) break; // cancelled
        worn[slot.name] = set;
        this.remove(scan);
      } catch (error) {
        this.fail(scan, wordsOf(problemOf(error)));
      }
    }
    const count = Object.keys(worn).length;
    if (count > 0 && (await studio.wear(model, worn)))
      studio.toasts.say(count === 1 ? t('1 expression is its own now.') : t('{count} expressions are its own now.', { count }));
    // The head has a copy, and nothing else uses them.
    await Promise.all(Object.values(worn).map((set) => studio.api.deleteExpression(set).catch(() => undefined)));
    this.busy.set(false);
  }

  /** Gives the head the library's expression again. */
  async takeOff(slot: string): Promise<void> {
    const model = this.studio.selected.value;
    if (!model || this.busy.value) return;
    this.busy.set(true);
    await this.studio.wear(model, { [slot]: null });
    this.busy.set(false);
  }

  private fail(scan: Scan, fault: string): void {
    this.scans.set(this.scans.value.map((one) => (one.file === scan.file ? { ...one, fault } : one)));
  }
}
