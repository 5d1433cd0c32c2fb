import { JsonCursor, parseJsonObject } from './json_cursor.ts';
import { featurePoints, type FapUnit } from './generated/mpeg4.ts';

/** rig.json: all data of a face except vertices and weights. Lengths in model units, axes of MPEG-4. */
export interface RigDocument {
  name: string;
  /** The level of detail of this package; 0 is the full mesh. */
  lod: number;
  /** All levels by lod; empty: only this one. */
  levels: RigLevel[];
  mesh: {
    sha256: string;
    vertices: number;
    triangles: number;
    bytes: number;
    /** Draco unique ids of the attributes; null: the mesh has no such attribute. */
    attributes: { position: number } & Record<'normal' | 'uv' | 'material' | 'file_vertex' | 'color', number | null>;
  };
  weights: {
    sha256: string;
    bytes: number;
    bits: number;
    max_influences: number;
    mean_influences: number;
    max_error: number;
  };
  /** Face animation parameter units, divided by 1024; null when their feature points are not marked. */
  fapu: Record<RigFapu, number | null>;
  feature_points: RigFeaturePoint[];
  /** Left, right. */
  eye_pivots: [Vec3, Vec3];
  head_pivot: Vec3;
  /** Left, right; null: the eye has no movable iris, and FAP 29 or 30 has no effect. */
  irises: [RigIris | null, RigIris | null];
  /** Null: no tongue that can roll; FAP 47 has no effect. */
  tongue: RigTongue | null;
  /** Left, right; null: the lids of the eye do not roll. */
  lids: [RigLids | null, RigLids | null];
  /** Feature points that follow others. */
  companions: RigCompanion[];
  /** Those that follow the jaw only if the player chooses so: the lower lip. */
  lower_lip: RigCompanion[];
  parts: RigPart[];
  /** Viseme share of Eq. 5. */
  viseme_share: number;
  /** The multiple of the usual opening of the jaw that `visemes` contain already. */
  articulation: number;
  /** 15; entry 0 is silence. */
  visemes: DisplacementSet[];
  /** 7; entry 0 is none. */
  expressions: DisplacementSet[];
  bounds: { min: Vec3; max: Vec3 };
  materials: RigMaterial[];
  images: RigImage[];
  warnings: string[];
}

export type Vec3 = [number, number, number];
export type RigFapu = Exclude<FapUnit, 'AU'>;

export interface RigFeaturePoint {
  id: string;
  /** Vertex of the decoded mesh; null for a position without a vertex. */
  vertex: number | null;
  position: Vec3;
}

/** The iris of one eye on the neutral face. */
export interface RigIris {
  /** Unit vector from the eye's pivot through the centre of the pupil. */
  axis: Vec3;
  pupil_radius: number;
  iris_radius: number;
  /** At distance r from the axis the surface lies bend * r * r farther along it. */
  bend: number;
}

/** The tongue on the neutral face. */
export interface RigTongue {
  /** A point on the tongue's middle line, at half its thickness. */
  origin: Vec3;
  /** Unit vector across the tongue, to the face's left. */
  left: Vec3;
  /** Unit vector at right angles to `left` and to the tongue's length. */
  up: Vec3;
  /** Distance from the middle line to a border. */
  half_width: number;
  /** Largest angle of a border without self-intersection of the tongue, radians. */
  roll_limit: number;
}

/** The lids of one eye, which slide round the line through its pivot along x. */
export interface RigLids {
  /** Unit vector from the pivot through the pupil. */
  gaze: Vec3;
  /** Angle about that line between the rims in the middle, radians. */
  slit: number;
  /** Displacement of the upper lid's point downwards that closes the eye. */
  opening: number;
  /** Upper and lower lid: share of the eye's pitch that the open lid follows. */
  gaze_share: [number, number];
  /** Distance of the eyeball's surface from the pivot, at 17 equal steps of sqrt(1 - cosine of the angle to `gaze`). */
  ball: number[];
  /** A vertex rises from the ball by this share of its way up or down: lids of few vertices are flat between them. 0 if left out. */
  lift?: number;
}

/** `point` moves by `share` of the displacement of `leader`. */
export interface RigCompanion {
  point: string;
  leader: string;
  share: number;
}

export interface RigLevel {
  vertices: number;
  triangles: number;
  /** Total bytes of mesh.drc and weights. */
  bytes: number;
}

export interface DisplacementSet {
  name: string;
  /** Displacements at full intensity, by feature point id. */
  displacements: Record<string, Vec3>;
}

export const partRoles = [
  'skin',
  'left_eye',
  'right_eye',
  'upper_teeth',
  'lower_teeth',
  'tongue',
  'attached',
  'rest',
  'body',
] as const;
export type PartRole = (typeof partRoles)[number];

export interface RigPart {
  name: string;
  role: PartRole;
  vertices: number;
  triangles: number;
}

export const alphaModes = ['opaque', 'mask', 'blend'] as const;

export interface RigMaterial {
  name: string;
  /** Linear RGBA. */
  base_color: [number, number, number, number];
  metallic: number;
  roughness: number;
  alpha_mode: (typeof alphaModes)[number];
  alpha_cutoff: number;
  double_sided: boolean;
  /** SHA-256 of an image, at /v1/artefacts/{sha256}. */
  base_color_image: string | null;
  normal_image: string | null;
}

export interface RigImage {
  sha256: string;
  mime_type: string;
  bytes: number;
}

export const rigFapus: readonly RigFapu[] = ['IRISD', 'ES', 'ENS', 'MNS', 'MW'];
export const visemeCount = 15;
export const expressionCount = 7;

/** Number of places at which an eyeball is sampled. */
export const ballPlaces = 17;
const halfTurn = 3.2;
const greatestShare = 10; // of a companion
const maxRigBytes = 16 << 20;
const maxText = 4096;
const maxList = 100_000;
const maxFloat = 3.4028234663852886e38;
const indexOfPoint = new Map(featurePoints.map((point, index) => [point.id, index]));

/** "2.1" -> dense index 0..83; undefined for an unknown id. */
export function featurePointIndex(id: string): number | undefined {
  return indexOfPoint.get(id);
}

const real = (at: JsonCursor): number => at.number(-maxFloat, maxFloat);
const natural = (at: JsonCursor): number => at.integer(0, 0xffff_ffff);
const size = (at: JsonCursor): number => at.integer(0, Number.MAX_SAFE_INTEGER);
const text = (at: JsonCursor): string => at.text(maxText);
const orNull = <T>(at: JsonCursor, read: (at: JsonCursor) => T): T | null => (at.isNull ? null : read(at));
const vec3 = (at: JsonCursor): Vec3 => at.elements(3, 3).map(real) as Vec3;

function hash(at: JsonCursor): string {
  const value = at.text(64);
  if (!/^[0-9a-fA-F]{64}$/.test(value)) at.fail('malformed', 'must be a SHA-256 as 64 hexadecimal digits');
  return value.toLowerCase();
}

function oneOf<T extends string>(at: JsonCursor, values: readonly T[]): T {
  const value = text(at);
  return values.find((known) => known === value) ?? at.fail('invalid_argument', `"${value}" is not a known value`);
}

function pointId(at: JsonCursor, id: string): string {
  if (!indexOfPoint.has(id)) at.fail('invalid_argument', `"${id}" is not a feature point`);
  return id;
}

/** Parses and validates rig.json. Throws ProtocolError with the JSON pointer. Unknown members are skipped. */
export function readRig(json: string): RigDocument {
  const root = parseJsonObject(json, maxRigBytes);
  if (text(root.member('format')) !== 'semblante.rig') {
    root.member('format').fail('malformed', 'must be "semblante.rig"');
  }
  if (natural(root.member('version')) !== 1) root.member('version').fail('unsupported', 'only version 1 is known');
  const mesh = root.member('mesh');
  const attributes = mesh.member('attributes');
  const weights = root.member('weights');
  const vertices = mesh.member('vertices').integer(1, 4_000_000);
  const list = <T>(name: string, most: number, read: (at: JsonCursor) => T): T[] =>
    root.member(name).elements(0, most).map(read);
  const levels = root.optional('levels')?.elements(1, maxList).map(readLevel) ?? [];
  return {
    name: text(root.member('name')),
    lod: levels.length > 0 ? root.member('lod').integer(0, levels.length - 1) : 0,
    levels,
    mesh: {
      sha256: hash(mesh.member('sha256')),
      vertices,
      triangles: natural(mesh.member('triangles')),
      bytes: size(mesh.member('bytes')),
      attributes: {
        position: natural(attributes.member('position')),
        normal: orNull(attributes.member('normal'), natural),
        uv: orNull(attributes.member('uv'), natural),
        material: orNull(attributes.member('material'), natural),
        file_vertex: orNull(attributes.member('file_vertex'), natural),
        color: attributes.optional('color')?.integer(0, 0xffffffff) ?? null,
      },
    },
    weights: {
      sha256: hash(weights.member('sha256')),
      bytes: size(weights.member('bytes')),
      bits: weights.member('bits').integer(8, 16),
      max_influences: weights.member('max_influences').integer(0, featurePoints.length),
      mean_influences: weights.member('mean_influences').number(0, featurePoints.length),
      max_error: weights.member('max_error').number(0, 1),
    },
    fapu: Object.fromEntries(
      rigFapus.map((unit) => [unit, orNull(root.member('fapu').member(unit), real)]),
    ) as RigDocument['fapu'],
    feature_points: readFeaturePoints(root.member('feature_points'), vertices),
    eye_pivots: root.member('eye_pivots').elements(2, 2).map(vec3) as [Vec3, Vec3],
    head_pivot: vec3(root.member('head_pivot')),
    irises: readIrises(root.optional('irises')),
    tongue: readTongue(root.optional('tongue')),
    lids: readBothLids(root.optional('lids')),
    companions: readCompanions(root.optional('companions')),
    lower_lip: readCompanions(root.optional('lower_lip')),
    parts: list('parts', maxList, readPart),
    viseme_share: root.member('viseme_share').number(0, 1),
    articulation: root.optional('articulation')?.number(0.25, 4) ?? 1,
    visemes: root.member('visemes').elements(visemeCount, visemeCount).map(readSet),
    expressions: root.member('expressions').elements(expressionCount, expressionCount).map(readSet),
    bounds: { min: vec3(root.member('bounds').member('min')), max: vec3(root.member('bounds').member('max')) },
    materials: root.member('materials').elements(1, 256).map(readMaterial),
    images: list('images', maxList, readImage),
    warnings: list('warnings', maxList, text),
  };
}

function readLevel(at: JsonCursor): RigLevel {
  return {
    vertices: natural(at.member('vertices')),
    triangles: natural(at.member('triangles')),
    bytes: size(at.member('bytes')),
  };
}

/** Reads a unit vector, with a tolerance for rounded digits. */
function direction(at: JsonCursor): Vec3 {
  const [x, y, z] = vec3(at);
  if (!(Math.abs(x * x + y * y + z * z - 1) < 1e-3)) at.fail('out_of_range', 'must be a unit vector');
  return [x, y, z];
}

function above(at: JsonCursor, least: number): number {
  const value = real(at);
  if (!(value > least)) at.fail('out_of_range', `must be more than ${least}`);
  return value;
}

function readIrises(at: JsonCursor | undefined): RigDocument['irises'] {
  if (at === undefined) return [null, null];
  return at.elements(2, 2).map((eye) => orNull(eye, readIris)) as RigDocument['irises'];
}

function readIris(at: JsonCursor): RigIris {
  const axis = direction(at.member('axis'));
  const pupil_radius = above(at.member('pupil_radius'), 0);
  const iris_radius = above(at.member('iris_radius'), pupil_radius);
  return { axis, pupil_radius, iris_radius, bend: real(at.member('bend')) };
}

function readTongue(at: JsonCursor | undefined): RigTongue | null {
  if (at === undefined || at.isNull) return null;
  const left = direction(at.member('left'));
  const up = direction(at.member('up'));
  if (!(Math.abs(left[0] * up[0] + left[1] * up[1] + left[2] * up[2]) < 1e-3)) {
    at.member('up').fail('out_of_range', 'must be perpendicular to left');
  }
  return {
    origin: vec3(at.member('origin')),
    left,
    up,
    half_width: above(at.member('half_width'), 0),
    roll_limit: at.member('roll_limit').number(0, 7),
  };
}

function readBothLids(at: JsonCursor | undefined): RigDocument['lids'] {
  if (at === undefined) return [null, null];
  return at.elements(2, 2).map((eye) => orNull(eye, readLids)) as RigDocument['lids'];
}

function readLids(at: JsonCursor): RigLids {
  const list = (name: string, count: number, low: number, high: number): number[] =>
    at
      .member(name)
      .elements(count, count)
      .map((value) => value.number(low, high));
  return {
    gaze: direction(at.member('gaze')),
    slit: at.member('slit').number(0, halfTurn),
    opening: above(at.member('opening'), 0),
    gaze_share: list('gaze_share', 2, 0, 1) as [number, number],
    ball: list('ball', ballPlaces, 0, maxFloat),
    lift: at.optional('lift')?.number(0, 1) ?? 0,
  };
}

function readCompanions(at: JsonCursor | undefined): RigCompanion[] {
  return (at?.members() ?? []).flatMap(([point, leaders]) =>
    leaders.members().map(([leader, share]) => ({
      point: pointId(leaders, point),
      leader: pointId(share, leader),
      share: share.number(-greatestShare, greatestShare),
    })),
  );
}

function readFeaturePoints(at: JsonCursor, vertices: number): RigFeaturePoint[] {
  let last = -1;
  return at.elements(0, featurePoints.length).map((point) => {
    const id = pointId(point.member('id'), text(point.member('id')));
    const index = indexOfPoint.get(id)!;
    if (index <= last) point.member('id').fail('malformed', 'ids must be increasing');
    last = index;
    return {
      id,
      vertex: orNull(point.member('vertex'), (vertex) => vertex.integer(0, vertices - 1)),
      position: vec3(point.member('position')),
    };
  });
}

function readSet(at: JsonCursor): DisplacementSet {
  const displacements: Record<string, Vec3> = {};
  for (const [id, value] of at.member('displacements').members()) displacements[pointId(value, id)] = vec3(value);
  return { name: text(at.member('name')), displacements };
}

function readPart(at: JsonCursor): RigPart {
  return {
    name: text(at.member('name')),
    role: oneOf(at.member('role'), partRoles),
    vertices: natural(at.member('vertices')),
    triangles: natural(at.member('triangles')),
  };
}

function readMaterial(at: JsonCursor): RigMaterial {
  return {
    name: text(at.member('name')),
    base_color: at.member('base_color').elements(4, 4).map(real) as RigMaterial['base_color'],
    metallic: real(at.member('metallic')),
    roughness: real(at.member('roughness')),
    alpha_mode: oneOf(at.member('alpha_mode'), alphaModes),
    alpha_cutoff: real(at.member('alpha_cutoff')),
    double_sided: at.member('double_sided').boolean(),
    base_color_image: orNull(at.member('base_color_image'), hash),
    normal_image: orNull(at.member('normal_image'), hash),
  };
}

function readImage(at: JsonCursor): RigImage {
  return {
    sha256: hash(at.member('sha256')),
    mime_type: text(at.member('mime_type')),
    bytes: size(at.member('bytes')),
  };
}
