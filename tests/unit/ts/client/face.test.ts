import { readFileSync } from 'node:fs';
import draco3d from 'draco3d';
import { beforeAll, describe, expect, it } from 'vitest';
import { assembleFace, FaceError, loadFace, type DracoModule, type Runtime } from '../../../../clients/js/index.ts';
import { loadRuntime } from '../support/runtime.ts';

const file = (name: string): Uint8Array =>
  new Uint8Array(readFileSync(new URL(`../../../../protocol/vectors/face/${name}`, import.meta.url)));
const files: Record<string, Uint8Array> = {
  'rig.json': file('rig.json'),
  weights: file('weights'),
  'mesh.drc': file('mesh.drc'),
};

/** A server that has the package, with some answers replaced. `requests` counts what was asked for. */
function server(replaced: Record<string, (nth: number) => Response> = {}): { fetch: typeof fetch; requests: string[] } {
  const requests: string[] = [];
  const answer = (input: unknown): Promise<Response> => {
    const url = String(input);
    requests.push(url);
    const name = url.split('/').at(-1)!.replace(/\?.*/, '');
    const nth = requests.filter((request) => request === url).length;
    return Promise.resolve(replaced[name]?.(nth) ?? new Response(files[name] as Uint8Array<ArrayBuffer>));
  };
  return { fetch: answer as typeof fetch, requests };
}

interface ChangeableRig {
  mesh: { sha256: string; vertices: number; triangles: number; attributes: { uv: number } };
}

function changedRig(change: (rig: ChangeableRig) => void): Uint8Array {
  const rig = JSON.parse(new TextDecoder().decode(files['rig.json'])) as ChangeableRig;
  change(rig);
  return new TextEncoder().encode(JSON.stringify(rig));
}

let draco: DracoModule;
let runtime: Runtime;
beforeAll(async () => {
  draco = (await draco3d.createDecoderModule({})) as unknown as DracoModule;
  runtime = await loadRuntime();
});

async function errorOf(rig: Uint8Array, weights: Uint8Array, mesh: Uint8Array): Promise<string> {
  try {
    await assembleFace(rig, weights, mesh, draco, runtime);
  } catch (error) {
    if (error instanceof FaceError) return error.code;
    throw error;
  }
  return 'accepted';
}

describe('loadFace', () => {
  it('Assemble_PartsThatDoNotBelongTogether_AreRefused', async () => {
    const rig = files['rig.json']!;
    const weights = files['weights']!;
    const mesh = files['mesh.drc']!;
    const other = mesh.slice();
    other[other.length - 1]! ^= 1;
    const otherWeights = weights.slice();
    otherWeights[40]! ^= 1;
    expect(await errorOf(rig, weights, other)).toBe('mismatch');
    expect(await errorOf(rig, otherWeights, mesh)).toBe('mismatch');
    expect(await errorOf(rig, weights, mesh.subarray(1))).toBe('mismatch');
    const moreVertices = changedRig((json) => (json.mesh.vertices = 197));
    expect(await errorOf(moreVertices, weights, mesh)).toBe('mismatch');
    const fewerTriangles = changedRig((json) => (json.mesh.triangles = 1));
    expect(await errorOf(fewerTriangles, weights, mesh)).toBe('mismatch');
    const noSuchAttribute = changedRig((json) => (json.mesh.attributes.uv = 77));
    expect(await errorOf(noSuchAttribute, weights, mesh)).toBe('malformed');
  });

  it('Load_FromAServer_GivesTheFace', async () => {
    const { fetch, requests } = server();
    const face = await loadFace('http://x/', 'my head', { draco, runtime, fetch });
    expect(requests.map((url) => url.replace(/.*models/, '')).sort()).toEqual(
      ['/my%20head/mesh.drc', '/my%20head/rig.json', '/my%20head/weights'],
    );
    expect(face.mesh.positions.length).toBe(face.rig.mesh.vertices * 3);
    expect(face.mesh.triangles.length).toBe(face.rig.mesh.triangles * 3);
    expect(face.mesh.uvs?.length).toBe(face.rig.mesh.vertices * 2);
    expect(face.influence.vertexCount).toBe(face.rig.mesh.vertices);
    // A feature point's own vertex follows it alone.
    const chin = face.rig.feature_points.find((point) => point.id === '2.1')!;
    const row = face.influence.rowOffsets[chin.vertex!]!;
    expect(face.influence.rowOffsets[chin.vertex! + 1]! - row).toBe(1);
    expect([face.influence.rowPoints[row], face.influence.rowWeights[row]]).toEqual([0, 1]);
    const at = Array.from(face.mesh.positions.subarray(chin.vertex! * 3, chin.vertex! * 3 + 3));
    at.forEach((coordinate, axis) => expect(coordinate).toBeCloseTo(chin.position[axis]!, 3));
  });

  it('Load_ALevelOfDetail_AsksForItInEveryPart', async () => {
    const ends = async (level: { maxVertices: number } | { lod: number }): Promise<string[]> => {
      const { fetch, requests } = server();
      await loadFace('http://x', 'm', { draco, runtime, fetch, level });
      return requests.map((url) => url.replace(/.*models/, '')).sort();
    };
    expect(await ends({ maxVertices: 8000 })).toEqual(
      ['mesh.drc', 'rig.json', 'weights'].map((name) => `/m/${name}?max_vertices=8000`),
    );
    expect(await ends({ lod: 2 })).toEqual(['mesh.drc', 'rig.json', 'weights'].map((name) => `/m/${name}?lod=2`));
  });

  it('Load_PackageReplacedInBetween_AsksOnceMore', async () => {
    const old = changedRig((json) => (json.mesh.sha256 = 'a'.repeat(64)));
    const { fetch, requests } = server({
      'rig.json': (nth) => new Response((nth === 1 ? old : files['rig.json']) as Uint8Array<ArrayBuffer>),
    });
    await loadFace('http://x', 'm', { draco, runtime, fetch });
    expect(requests.length).toBe(6);
  });

  it('Load_NotThere_SaysTheStatus', async () => {
    const { fetch } = server({ weights: () => new Response('', { status: 404 }) });
    await expect(loadFace('http://x', 'm', { draco, runtime, fetch })).rejects.toMatchObject({ code: 'http', status: 404 });
  });

  it('Load_MeshOfRandomBytes_IsRefused', async () => {
    const { fetch } = server({ 'mesh.drc': () => new Response(new Uint8Array(500).fill(7)) });
    await expect(loadFace('http://x', 'm', { draco, runtime, fetch })).rejects.toMatchObject({ code: 'mismatch' });
  });
});
