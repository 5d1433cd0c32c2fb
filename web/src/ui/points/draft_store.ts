import type { PlacedPoint, PointChange, PointChanges, PointOrNone } from '../../face/point_draft.ts';
import { pointById } from '../../face/feature_points.ts';

const prefix = 'semblante.draft.';

/**
 * Keeps the unsaved points of each head in the browser, so that they survive a reload, a change of head and a lost network.
 * Only what differs from the server's points is kept, with what it was made over: what others save in the meantime stays theirs, and is
 * seen when it is of the same point. Pages that are open at the same time share the storage: each replaces only what it has kept or read
 * itself.
 */
export class DraftStore {
  /** By head the ids that this page has kept or read. */
  private readonly own = new Map<string, ReadonlySet<string>>();

  constructor(private readonly storage: Storage | null) {}

  /** `axes`: the axes of the head; positions of other axes are of no use. */
  keep(head: string, axes: string, changes: PointChanges): void {
    const own = this.own.get(head);
    const others = [...this.stored(head, axes)].filter(([id]) => !own?.has(id));
    const all = new Map([...others, ...changes]);
    this.own.set(head, new Set(changes.keys()));
    try {
      if (all.size === 0) this.storage?.removeItem(prefix + head);
      else this.storage?.setItem(prefix + head, JSON.stringify({ axes, points: column(all, 'point'), over: column(all, 'over') }));
    } catch {
      return; // storage is full or forbidden: the draft lasts as long as the page
    }
  }

  /** Also what other pages have kept of it. */
  forget(head: string): void {
    this.own.delete(head);
    try {
      this.storage?.removeItem(prefix + head);
    } catch {
      return; // as above
    }
  }

  /** What was kept of a head, to be changed by this page. */
  read(head: string, axes: string): PointChanges {
    const changes = this.stored(head, axes);
    this.own.set(head, new Set(changes.keys()));
    return changes;
  }

  /** What is not understood is left out. */
  private stored(head: string, axes: string): PointChanges {
    const changes = new Map<string, PointChange>();
    try {
      const kept = JSON.parse(this.storage?.getItem(prefix + head) ?? 'null') as unknown;
      if (!isRecord(kept) || kept['axes'] !== axes || !isRecord(kept['points'])) return changes;
      const over = isRecord(kept['over']) ? kept['over'] : {};
      for (const [id, value] of Object.entries(kept['points'])) {
        const point = pointOrNone(value);
        if (pointById(id) !== undefined && point !== undefined) changes.set(id, { point, over: pointOrNone(over[id]) });
      }
    } catch {
      return changes;
    }
    return changes;
  }
}

const column = (changes: PointChanges, member: keyof PointChange): Record<string, PointOrNone | undefined> =>
  Object.fromEntries([...changes].map(([id, change]) => [id, change[member]]));

/** undefined: not understood. */
const pointOrNone = (value: unknown): PointOrNone | undefined => (value === null ? null : pointOf(value));

function pointOf(value: unknown): PlacedPoint | undefined {
  if (!isRecord(value)) return undefined;
  const { vertex, position, proposal } = value;
  if (vertex !== null && !(Number.isSafeInteger(vertex) && (vertex as number) >= 0)) return undefined;
  if (!Array.isArray(position) || position.length !== 3 || !position.every((part) => Number.isFinite(part))) return undefined;
  const point = { vertex: vertex as number | null, position: position as [number, number, number] };
  if (!isRecord(proposal)) return point;
  const { method, confidence, expectedError, remark } = proposal;
  return {
    ...point,
    proposal: {
      method: typeof method === 'string' ? method : null,
      confidence: confidence === 'high' || confidence === 'medium' || confidence === 'low' ? confidence : null,
      expectedError: typeof expectedError === 'number' ? expectedError : null,
      ...(typeof remark === 'string' ? { remark } : {}),
    },
  };
}

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === 'object' && value !== null && !Array.isArray(value);
