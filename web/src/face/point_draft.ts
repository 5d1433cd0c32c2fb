import { pointById } from './feature_points.ts';

export interface PlacedPoint {
  /** The vertex of the file it lies on; null for a bare position. */
  vertex: number | null;
  position: readonly [number, number, number];
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

  clear(): void {
    if (this.current.size === 0) return;
    this.step();
    this.current.clear();
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

  /** The body of a PUT: a vertex where there is one, else the position. */
  toBody(): { points: Record<string, { vertex: number } | { position: readonly number[] }> } {
    const points: Record<string, { vertex: number } | { position: readonly number[] }> = {};
    for (const [id, point] of this.current) {
      points[id] = point.vertex === null ? { position: point.position } : { vertex: point.vertex };
    }
    return { points };
  }

  private step(): void {
    this.history.push(new Map(this.current));
    if (this.history.length > 200) this.history.shift();
    this.undone = [];
  }
}

function same(a: PlacedPoint | undefined, b: PlacedPoint | undefined): boolean {
  if (a === undefined || b === undefined) return a === b;
  if (a.vertex !== null || b.vertex !== null) return a.vertex === b.vertex;
  return a.position.every((value, axis) => value === b.position[axis]);
}
