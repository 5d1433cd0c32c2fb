import { describe, expect, it } from 'vitest';
import { featurePointIndex, ProtocolError, readRig } from '../../../../protocol/ts/index.ts';
import type { RigDocument } from '../../../../protocol/ts/rig_document.ts';
import { vectorJson } from './vectors.ts';

type Json = Record<string, never>;
const good = vectorJson('rig.json') as Json;

function errorOf(change: (json: Json) => void): { code: string; where: string } {
  const json = structuredClone(good);
  change(json);
  try {
    readRig(JSON.stringify(json));
  } catch (error) {
    if (error instanceof ProtocolError) return { code: error.code, where: error.where };
    throw error;
  }
  throw new Error('was not refused');
}

function set(path: string, value: unknown): (json: Json) => void {
  return (json) => {
    const keys = path.split('/').slice(1);
    let node = json as Record<string, unknown>;
    for (const key of keys.slice(0, -1)) node = node[key] as Record<string, unknown>;
    node[keys.at(-1)!] = value;
  };
}

describe('readRig', () => {
  it.each([
    ['/format', 'malformed', 'other'],
    ['/version', 'unsupported', 2],
    ['/name', 'malformed', 3],
    ['/mesh', 'malformed', 1],
    ['/mesh/sha256', 'malformed', 'abc'],
    ['/mesh/vertices', 'out_of_range', 4_000_001],
    ['/mesh/attributes/position', 'malformed', null],
    ['/weights/bits', 'out_of_range', 17],
    ['/fapu/MW', 'malformed', 'wide'],
    ['/feature_points/0/vertex', 'out_of_range', 100],
    ['/feature_points/0/id', 'invalid_argument', '2.99'],
    ['/feature_points/1/id', 'malformed', '2.1'],
    ['/parts/1/role', 'invalid_argument', 'hat'],
    ['/viseme_share', 'out_of_range', 1.5],
    ['/articulation', 'out_of_range', 5],
    ['/visemes', 'out_of_range', []],
    ['/visemes/3/displacements/99.1', 'invalid_argument', [0, 0, 0]],
    ['/materials', 'out_of_range', []],
    ['/images/0/sha256', 'malformed', 'g'.repeat(64)],
    ['/warnings/0', 'malformed', 1],
  ])('Read_Invalid_IsNamedByItsPointer: %s %s', (where, code, value) => {
    expect(errorOf(set(where, value))).toEqual({ where, code });
  });

  it('Read_EveryMemberRemoved_IsRefusedByName', () => {
    for (const name of Object.keys(good)) {
      expect(errorOf((json) => delete json[name])).toEqual({ where: `/${name}`, code: 'missing' });
    }
  });

  it('Read_Color_IsAnAttributeOrAbsent', () => {
    expect(readRig(JSON.stringify(good)).mesh.attributes.color).toBeNull();
    const json = structuredClone(good);
    set('/mesh/attributes/color', 5)(json);
    expect(readRig(JSON.stringify(json)).mesh.attributes.color).toBe(5);
    const where = '/mesh/attributes/color';
    expect(errorOf(set(where, -1))).toEqual({ where, code: 'out_of_range' });
  });

  it('Read_MovingParts_AreEmptyWhereTheDocumentHasNone', () => {
    const rig = readRig(JSON.stringify(good));
    expect(rig.irises).toEqual([null, null]);
    expect(rig.tongue).toBeNull();
    const parts = readRig(JSON.stringify(vectorJson('../v2/rig.json')));
    expect(parts.irises).toEqual([
      { axis: [0.6, 0, 0.8], pupil_radius: 0.002, iris_radius: 0.006, bend: -40 },
      null,
    ]);
    expect(parts.tongue).toEqual({
      origin: [0, -0.05, 0.02],
      left: [1, 0, 0],
      up: [0, 0.8, 0.6],
      half_width: 0.02,
      roll_limit: 2.5,
    });
  });

  it.each([
    ['/irises', 'out_of_range', []],
    ['/irises/0/axis', 'out_of_range', [0, 0, 0.5]],
    ['/irises/0/pupil_radius', 'out_of_range', 0],
    ['/irises/0/iris_radius', 'out_of_range', 0.002],
    ['/irises/0/bend', 'malformed', null],
    ['/tongue/left', 'out_of_range', [2, 0, 0]],
    ['/tongue/up', 'out_of_range', [1, 0, 0]],
    ['/tongue/half_width', 'out_of_range', -1],
    ['/tongue/roll_limit', 'out_of_range', 8],
  ])('Read_InvalidMovingParts_AreNamedByTheirPointer: %s %s', (where, code, value) => {
    const withParts = (json: Json): void => {
      Object.assign(json, vectorJson('../v2/rig.json'));
      set(where, value)(json);
    };
    expect(errorOf(withParts)).toEqual({ where, code });
  });

  it('Read_LidsAndCompanions', () => {
    const rig = readRig(JSON.stringify(vectorJson('../v3/rig.json')));
    const [left, right] = rig.lids;
    expect(right).toBeNull();
    expect(left).toMatchObject({ gaze: [0, -0.6, 0.8], slit: 0.5, opening: 0.01, gaze_share: [0.75, 0.3] });
    expect([left!.ball.length, left!.ball[1]]).toEqual([17, 0.3125]);
    expect(rig.companions).toEqual([
      { point: '2.10', leader: '2.1', share: 0.95 },
      { point: '5.1', leader: '2.1', share: 0.25 },
      { point: '5.1', leader: '8.3', share: 0.5 },
    ]);
    expect(rig.lower_lip).toEqual([{ point: '2.3', leader: '2.1', share: 0.9 }]);
  });

  it.each([
    ['/lids', 'out_of_range', []],
    ['/lids/0/gaze', 'out_of_range', [0.8, 0, 0]],
    ['/lids/0/opening', 'out_of_range', 0],
    ['/lids/0/slit', 'out_of_range', 4],
    ['/lids/0/ball', 'out_of_range', [1]],
    ['/lids/0/ball/8', 'out_of_range', -1],
    ['/companions/2.10/2.1', 'out_of_range', 11],
    ['/companions/2.15', 'invalid_argument', { '2.1': 1 }],
    ['/companions/2.10/jaw', 'invalid_argument', 1],
    ['/lower_lip/2.3', 'malformed', 1],
  ])('Read_InvalidLidsAndCompanions_AreNamedByTheirPointer: %s %s', (where, code, value) => {
    const withParts = (json: Json): void => {
      Object.assign(json, vectorJson('../v3/rig.json'));
      set(where, value)(json);
    };
    expect(errorOf(withParts)).toEqual({ where, code });
  });

  it('Read_Golden_GivesItsMembers', () => {
    const rig = readRig(JSON.stringify(good));
    const { format, version, ...members } = good as Record<string, unknown>;
    expect([format, version]).toEqual(['semblante.rig', 1]);
    // A document of before there were levels is the full mesh alone; one of before irises and tongue moved has none.
    const later = { lids: [null, null], companions: [], lower_lip: [], articulation: 1 };
    const mesh = members['mesh'] as RigDocument['mesh'];
    const withoutColors = { mesh: { ...mesh, attributes: { ...mesh.attributes, color: null } } };
    expect(rig).toEqual({ lod: 0, levels: [], irises: [null, null], tongue: null, ...later, ...members, ...withoutColors });
  });
});

describe('featurePointIndex', () => {
  it('KnowsThe84', () => {
    expect(['2.1', '2.2', '11.6', '2.99', ''].map(featurePointIndex)).toEqual([0, 1, 83, undefined, undefined]);
  });
});
