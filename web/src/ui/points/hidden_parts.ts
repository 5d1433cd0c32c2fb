import type { ModelPart } from '../../net/types.ts';
import { Signal } from '../shared/signal.ts';
import type { Studio } from '../shared/studio.ts';
import type { SettingsStore } from './settings_store.ts';

/** The parts of the open head that are hidden while its points are placed, by index. */
export class HiddenParts {
  readonly hidden = new Signal<ReadonlySet<number>>(new Set());
  private head: string | null = null;

  constructor(
    private readonly studio: Studio,
    private readonly store: SettingsStore,
  ) {
    studio.selected.watch((model) => {
      if ((model?.id ?? null) === this.head) return;
      this.head = model?.id ?? null;
      this.hidden.set(new Set(model ? store.read(model.id).hidden : []));
    });
  }

  get parts(): readonly ModelPart[] {
    return this.studio.selected.value?.parts ?? [];
  }

  set(parts: readonly number[], hide: boolean): void {
    const next = new Set(this.hidden.value);
    for (const part of parts) {
      if (hide) next.add(part);
      else next.delete(part);
    }
    this.take(next);
  }

  showAll(): void {
    this.take(new Set());
  }

  private take(hidden: ReadonlySet<number>): void {
    this.hidden.set(hidden);
    if (this.head !== null) this.store.change(this.head, { hidden: [...hidden] });
  }
}
