import { pairOf, partnerOf } from '../../face/mirror_points.ts';
import { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';
import type { SettingsStore } from './settings_store.ts';

/** Whether left and right points of the open head move together, all but the pairs that are taken apart. */
export class MirrorLock {
  readonly on = new Signal(false);
  /** Pairs whose points move alone, by `pairOf`. */
  readonly apart = new Signal<ReadonlySet<string>>(new Set());
  private head: string | null = null;

  constructor(
    studio: Studio,
    private readonly store: SettingsStore,
  ) {
    studio.selected.watch((model) => {
      if ((model?.id ?? null) === this.head) return;
      this.head = model?.id ?? null;
      const { locked, apart } = store.read(model?.id ?? '');
      this.apart.set(new Set(apart));
      this.on.set(locked);
    });
  }

  /** The point that moves with this one; null: none. */
  twinOf(id: string): string | null {
    return this.on.value && !this.apart.value.has(pairOf(id)) ? partnerOf(id) : null;
  }

  lock(on: boolean): void {
    this.on.set(on);
    if (this.head !== null) this.store.change(this.head, { locked: on });
  }

  /** Links the two points of a pair, or lets each move alone. */
  link(id: string, linked: boolean): void {
    const apart = new Set(this.apart.value);
    if (linked) apart.delete(pairOf(id));
    else apart.add(pairOf(id));
    this.apart.set(apart);
    if (this.head !== null) this.store.change(this.head, { apart: [...apart] });
  }
}
