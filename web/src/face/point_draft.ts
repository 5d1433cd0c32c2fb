import { pointById } from './feature_points.ts';

export type Confidence = 'high' | 'medium' | 'low';

/** How a point was proposed that nobody has placed or confirmed yet. */
export interface PointProposal {
  method: string | null;
  confidence: Confidence | null;
  /** Share of ES0, or null where it is not known. */
  expectedError: number | null;
  /** What else makes it unsure, in words. */
  remark?: string;
}

export interface PlacedPoint {
  /** The vertex of the file it lies on; null for a bare position. */
  vertex: number | null;
  position: readonly [number, number, number];
  /** Only of a point that is proposed. */
  proposal?: PointProposal;
}

export type PointsById = ReadonlyMap<string, PlacedPoint>;

/** The feature points while they are edited: what is saved, what is not yet, and the way back. */
export class PointDraft {
  private saved = new Map<string, PlacedPoint>();
  private current = new Map<string, PlacedPoint>();
  private undone: Map<string, PlacedPoint>[] = [];
  private history: Map<string, PlacedPoint>[] = [];

  get points(): PointsById {
    return this.current;
  }

  /** Takes over what the server has; forgets the history. */
  reset(points: Iterable<[string, PlacedPoint]>): void {
    this.saved = new Map([...points].filter(([id]) => pointById(id) !== undefined));
    this.current = new Map(this.saved);
    this.history = [];
    this.undone = [];
  }

  place(id: string, point: PlacedPoint): void {
    if (pointById(id) === undefined) throw new RangeError(`no feature point ${id}`);
    this.step();
    this.current.set(id, point);
  }

  remove(id: string): void {
    if (!this.current.has(id)) return;
    this.step();
    this.current.delete(id);
  }

  /** Ids of the points that are proposed, in the order they came. */
  get proposed(): string[] {
    return [...this.current].filter(([, point]) => point.proposal).map(([id]) => id);
  }

  /** Takes proposed points for placed ones. */
  confirm(ids: readonly string[]): void {
    this.change(ids, ({ vertex, position }) => ({ vertex, position }));
  }

  /** Takes proposed points away. */
  discard(ids: readonly string[]): void {
    this.change(ids, () => null);
  }

  /** Exchanges left and right of these points and their mirror points. */
  exchange(ids: readonly string[]): void {
    const before = new Map(this.current);
    const both = new Set(ids.flatMap((id) => [id, pointById(id)?.mirror ?? id]));
    this.step();
    for (const id of both) {
      const other = before.get(pointById(id)?.mirror ?? id);
      if (other) this.current.set(id, other);
      else this.current.delete(id);
    }
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

  /** How many points differ from what the server has. */
  get changes(): number {
    let count = 0;
    for (const id of new Set([...this.saved.keys(), ...this.current.keys()])) if (this.isChanged(id)) count += 1;
    return count;
  }

  /**
   * The body of a PUT: the vertex where there is one, the position, and what is known of a proposal. The position goes
   * along with the vertex: points marked on another file of the same head have vertex numbers that mean nothing here.
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
    for (const id of concerned) {
      const changed = make(this.current.get(id)!);
      if (changed) this.current.set(id, changed);
      else this.current.delete(id);
    }
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

/** As the REST interface and files of feature points have it. */
export function proposalBody({ method, confidence, expectedError, remark }: PointProposal): PointBody {
  const body: PointBody = { proposed: true };
  if (method !== null) body.method = method;
  if (confidence !== null) body.confidence = confidence;
  if (expectedError !== null) body.expected_error = expectedError;
  if (remark !== undefined) body.remark = remark;
  return body;
}

function same(a: PlacedPoint | undefined, b: PlacedPoint | undefined): boolean {
  if (a === undefined || b === undefined) return a === b;
  if ((a.proposal === undefined) !== (b.proposal === undefined)) return false;
  if (a.vertex !== null || b.vertex !== null) return a.vertex === b.vertex;
  return a.position.every((value, axis) => value === b.position[axis]);
}
