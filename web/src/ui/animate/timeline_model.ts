import { endOf, placed, withCues, type Cue, type CueDocument } from '../../face/cue_sheet.ts';
import { Signal } from '../shared/signal.ts';

/** Steps that can be undone. */
const longestHistory = 200;

/** The cues of one document, the chosen cue, and what was changed, with undo and redo. */
export class TimelineModel {
  readonly document = new Signal<CueDocument | null>(null);
  /** Index of the chosen cue in the document, or -1. */
  readonly chosen = new Signal(-1);
  private past: CueDocument[] = [];
  private future: CueDocument[] = [];

  /** `onEdit` is called with the document after each change, also by undo and redo. */
  constructor(private readonly onEdit: (document: CueDocument) => void) {}

  get cues(): readonly Cue[] {
    return this.document.value?.cues ?? [];
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  /** The length of the time line, ms: of the document, or up to the end of the last cue. */
  get length(): number {
    return Math.max(1000, this.document.value?.duration ?? 0, ...this.cues.map(endOf));
  }

  open(document: CueDocument | null): void {
    this.past = [];
    this.future = [];
    this.chosen.set(-1);
    this.document.set(document);
  }

  choose(index: number): void {
    this.chosen.set(Math.min(index, this.cues.length - 1));
  }

  /** Chooses the cue `step` further in time, with the first or last one where there is no further one. */
  chooseNext(step: number): void {
    if (this.cues.length > 0) this.choose(Math.max(0, this.chosen.value + step));
  }

  /** Moves the chosen cue to `start` and `end`, ms. */
  place(start: number, end: number): void {
    const cue = this.cues[this.chosen.value];
    if (cue) this.replaceChosen(placed(cue, start, end));
  }

  add(cue: Cue): void {
    this.edit([...this.cues, cue], cue);
  }

  remove(): void {
    const { value: at } = this.chosen;
    if (!this.cues[at]) return;
    this.edit(
      this.cues.filter((_, i) => i !== at),
      null,
    );
  }

  undo(): void {
    this.step(this.past, this.future);
  }

  redo(): void {
    this.step(this.future, this.past);
  }

  private replaceChosen(cue: Cue): void {
    const at = this.chosen.value;
    this.edit(
      this.cues.map((one, i) => (i === at ? cue : one)),
      cue,
    );
  }

  private edit(cues: readonly Cue[], chosen: Cue | null): void {
    const { value: before } = this.document;
    if (!before) return;
    this.past = [...this.past.slice(1 - longestHistory), before];
    this.future = [];
    this.show(withCues(before, cues), chosen);
  }

  private step(from: CueDocument[], to: CueDocument[]): void {
    const next = from.pop();
    if (!next || !this.document.value) return;
    to.push(this.document.value);
    this.show(next, null);
  }

  /** `chosen`: null keeps the place in the list. */
  private show(document: CueDocument, chosen: Cue | null): void {
    const cues = document.cues ?? [];
    this.chosen.set(chosen ? cues.indexOf(chosen) : Math.min(this.chosen.value, cues.length - 1));
    this.document.set(document);
    this.onEdit(document);
  }
}
