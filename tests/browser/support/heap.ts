import type { CDPSession } from 'playwright-core';

/** Bytes by what holds them, as "object Kernel" or "array (object elements)". */
export type Holdings = Map<string, number>;

/** Of a heap snapshot: what scripts make. Not among them: compiled code and the browser's own records, which come and go. */
const madeByScripts = new Set(['array', 'string', 'object', 'closure', 'regexp', 'number', 'concatenated string', 'sliced string', 'symbol', 'bigint']);
/** The contents of typed arrays and of WebAssembly's memories. */
const bufferData = 'system / JSArrayBufferData';

interface Snapshot {
  snapshot: { meta: { node_fields: string[]; node_types: [string[], ...unknown[]] } };
  nodes: number[];
  strings: string[];
}

/** What the scripts of a page hold after the collector has run: objects, typed arrays, memories of WebAssembly. */
export async function heldByScripts(devtools: CDPSession): Promise<Holdings> {
  const chunks: string[] = [];
  const take = ({ chunk }: { chunk: string }): void => void chunks.push(chunk);
  // The second run collects what the first one's finalizers let go.
  await devtools.send('HeapProfiler.collectGarbage');
  await new Promise((next) => setTimeout(next, 100));
  devtools.on('HeapProfiler.addHeapSnapshotChunk', take);
  await devtools.send('HeapProfiler.takeHeapSnapshot', { reportProgress: false });
  devtools.off('HeapProfiler.addHeapSnapshotChunk', take);
  const { snapshot, nodes, strings } = JSON.parse(chunks.join('')) as Snapshot;
  const { node_fields: fields, node_types: [types] } = snapshot.meta;
  const [type, name, size] = ['type', 'name', 'self_size'].map((field) => fields.indexOf(field)) as [number, number, number];
  const held: Holdings = new Map();
  for (let i = 0; i < nodes.length; i += fields.length) {
    const kind = types[nodes[i + type]!]!;
    const called = strings[nodes[i + name]!]!;
    if (!madeByScripts.has(kind) && called !== bufferData) continue;
    const key = kind === 'object' || kind === 'array' || kind === 'native' ? `${kind} ${called}` : kind;
    held.set(key, (held.get(key) ?? 0) + nodes[i + size]!);
  }
  return held;
}

export const bytesOf = (held: Holdings): number => [...held.values()].reduce((sum, bytes) => sum + bytes, 0);

/** The names with the most new bytes, for the message of a test that fails. */
export function growthOf(before: Holdings, after: Holdings, names = 8): string {
  const grown = [...after].map(([name, bytes]) => ({ name, more: bytes - (before.get(name) ?? 0) })).filter(({ more }) => more > 0);
  grown.sort((a, b) => b.more - a.more);
  return grown.slice(0, names).map(({ name, more }) => `${name} +${more}`).join(', ');
}
