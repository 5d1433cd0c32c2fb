import { pointById } from './feature_points.ts';

export type Confidence = 'high' | 'medium' | 'low';

/** Origin and quality of a proposed point that no person has placed or confirmed yet. */
export interface PointProposal {
  method: string | null;
  confidence: Confidence | null;
  /** Expected error as a fraction of ES0 (the distance between the eyes); null when unknown. */
  expectedError: number | null;
  /** A further reason for doubt, as text. */
  remark?: string;
}

export interface PlacedPoint {
  /** Number of the file's vertex at the point; null for a position without a vertex. */
  vertex: number | null;
  position: readonly [number, number, number];
  /** Present only for a proposed point. */
  proposal?: PointProposal;
}

export type PointsById = ReadonlyMap<string, PlacedPoint>;

/** A point before or after a change; null: there is none. */
export type PointOrNone = PlacedPoint | null;

/** An unsaved change of a point: what it is now, and the server's point that it was made over; undefined: that is not known. */
export interface PointChange {
  point: PointOrNone;
  over: PointOrNone | undefined;
}

export type PointChanges = ReadonlyMap<string, PointChange>;

/** The feature points during editing: the saved set, the unsaved changes and the undo history. */
export class PointDraft {
  private saved = new Map<string, PlacedPoint>();
  private current = new Map<string, PlacedPoint>();
  private undone: Map<string, PlacedPoint>[] = [];
  private history: Map<string, PlacedPoint>[] = [];

  get points(): PointsById {
    return this.current;
  }

  /** Replaces the draft by the server's points and clears the undo history. */
  reset(points: Iterable<[string, PlacedPoint]>): void {
    this.saved = new Map([...points].filter(([id]) => pointById(id) !== undefined));
    this.current = new Map(this.saved);
    this.history = [];
    this.undone = [];
  }

  /** Takes the server's points after a change of this page: a step that can be undone, unless they are the draft already. */
  accept(points: Iterable<[string, PlacedPoint]>): void {
    this.saved = new Map([...points].filter(([id]) => pointById(id) !== undefined));
    if (this.changes > 0) this.step();
    this.current = new Map(this.saved);
  }

  /**
   * Takes points that someone else has saved: whatever is not changed here follows them, also in the steps that can be undone or
   * redone, so that undoing a change of one's own undoes nothing of theirs. Unsaved changes stay. `changed`: the ids that differ
   * from before and from the draft, so not those that this page has saved without hearing the answer; `contested`: those among them
   * that have an unsaved change here, each with the server's point from before.
   */
  rebase(points: Iterable<[string, PlacedPoint]>): { changed: string[]; contested: Map<string, PointOrNone> } {
    const before = this.saved;
    const now = new Map([...points].filter(([id]) => pointById(id) !== undefined));
    const changed = [...new Set([...before.keys(), ...now.keys()])].filter((id) => !same(before.get(id), now.get(id)));
    const unknown = changed.filter((id) => !same(this.current.get(id), now.get(id)));
    const contested = new Map(unknown.filter((id) => this.isChanged(id)).map((id) => [id, before.get(id) ?? null]));
    for (const state of [this.current, ...this.history, ...this.undone])
      for (const id of changed) if (same(state.get(id), before.get(id))) put(state, id, now.get(id));
    this.saved = now;
    return { changed: unknown, contested };
  }

  /** Gives up the unsaved changes of these points, as one step that can be undone. */
  takeSaved(ids: readonly string[]): void {
    if (!ids.some((id) => this.isChanged(id))) return;
    this.step();
    for (const id of ids) put(this.current, id, this.saved.get(id));
  }

  /**
   * Takes changes of an earlier visit as one step that can be undone. `isRead`: the saved set is the server's, which may have changed
   * since then; otherwise what the changes were made over stands for it. Returns the contested points, as `rebase` does.
   */
  restore(changes: PointChanges, isRead: boolean): Map<string, PointOrNone> {
    if ([...changes].every(([id, { point }]) => same(this.current.get(id), point ?? undefined))) return new Map();
    const server = new Map(this.saved);
    for (const [id, { over }] of changes) {
      if (over === undefined) continue;
      put(this.saved, id, over ?? undefined);
      put(this.current, id, over ?? undefined);
    }
    this.step();
    for (const [id, { point }] of changes) put(this.current, id, point ?? undefined);
    return isRead ? this.rebase(server).contested : new Map();
  }

  /** Takes other points as one step that can be undone. */
  replace(points: PointsById): void {
    this.step();
    this.current = new Map(points);
  }

  place(id: string, point: PlacedPoint): void {
    this.placeAll([[id, point]]);
  }

  /** Places several points as one step. */
  placeAll(points: readonly (readonly [string, PlacedPoint])[]): void {
    for (const [id] of points) if (pointById(id) === undefined) throw new RangeError(`no feature point ${id}`);
    this.step();
    for (const [id, point] of points) this.current.set(id, point);
  }

  /** Removes points as one step. */
  remove(...ids: readonly string[]): void {
    if (!ids.some((id) => this.current.has(id))) return;
    this.step();
    for (const id of ids) this.current.delete(id);
  }

  /** Ids of the proposed points, in the server's order. */
  get proposed(): string[] {
    return [...this.current].filter(([, point]) => point.proposal).map(([id]) => id);
  }

  /** Turns proposed points into placed points. */
  confirm(ids: readonly string[]): void {
    this.change(ids, ({ vertex, position }) => ({ vertex, position }));
  }

  /** Removes proposed points. */
  discard(ids: readonly string[]): void {
    this.change(ids, () => null);
  }

  /** Exchanges each of these points with its mirror point. */
  exchange(ids: readonly string[]): void {
    const before = new Map(this.current);
    const both = new Set(ids.flatMap((id) => [id, pointById(id)?.mirror ?? id]));
    this.step();
    for (const id of both) put(this.current, id, before.get(pointById(id)?.mirror ?? id));
  }

  undo(): boolean {
    const before = this.history.pop();
    if (!before) return false;
    this.undone.push(this.current);
    this.current = before;
    return true;
  }

  redo(): boolean {
    const after = this.undone.pop();
    if (!after) return false;
    this.history.push(this.current);
    this.current = after;
    return true;
  }

  get canUndo(): boolean {
    return this.history.length > 0;
  }

  get canRedo(): boolean {
    return this.undone.length > 0;
  }

  isChanged(id: string): boolean {
    return !same(this.saved.get(id), this.current.get(id));
  }

  /** The points that differ from the server's. */
  get changed(): Map<string, PointChange> {
    const ids = [...new Set([...this.saved.keys(), ...this.current.keys()])].filter((id) => this.isChanged(id));
    return new Map(ids.map((id) => [id, { point: this.current.get(id) ?? null, over: this.saved.get(id) ?? null }]));
  }

  /** Number of points that differ from the server's. */
  get changes(): number {
    return this.changed.size;
  }

  /**
   * The body of a PUT request: vertex (where known), position, and the facts of a proposal. The position is sent beside
   * the vertex because points marked on another file of the same head have vertex numbers that are not valid here.
   */
  toBody(): { points: Record<string, PointBody> } {
    const points: Record<string, PointBody> = {};
    for (const [id, { vertex, position, proposal }] of this.current)
      points[id] = { ...(vertex === null ? {} : { vertex }), position: [...position], ...(proposal ? proposalBody(proposal) : {}) };
    return { points };
  }

  private change(ids: readonly string[], make: (point: PlacedPoint) => PlacedPoint | null): void {
    const concerned = ids.filter((id) => this.current.get(id)?.proposal);
    if (concerned.length === 0) return;
    this.step();
    for (const id of concerned) put(this.current, id, make(this.current.get(id)!) ?? undefined);
  }

  private step(): void {
    this.history.push(new Map(this.current));
    if (this.history.length > 200) this.history.shift();
    this.undone = [];
  }
}

export interface PointBody {
  vertex?: number;
  position?: [number, number, number];
  proposed?: true;
  method?: string;
  confidence?: Confidence;
  expected_error?: number;
  remark?: string;
}

/** Converts a proposal to its JSON form in the REST interface and in feature point files. */
export function proposalBody({ method, confidence, expectedError, remark }: PointProposal): PointBody {
  const body: PointBody = { proposed: true };
  if (method !== null) body.method = method;
  if (confidence !== null) body.confidence = confidence;
  if (expectedError !== null) body.expected_error = expectedError;
  if (remark !== undefined) body.remark = remark;
  return body;
}

function put(points: Map<string, PlacedPoint>, id: string, point: PlacedPoint | undefined): void {
  if (point) points.set(id, point);
  else points.delete(id);
}

function same(a: PlacedPoint | undefined, b: PlacedPoint | undefined): boolean {
  if (a === undefined || b === undefined) return a === b;
  if ((a.proposal === undefined) !== (b.proposal === undefined)) return false;
  if (a.vertex !== null || b.vertex !== null) return a.vertex === b.vertex;
  return a.position.every((value, axis) => value === b.position[axis]);
}
