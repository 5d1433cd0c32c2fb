/** The shapes of the REST interface (`/openapi.json`) that the studio uses. */

export interface FieldProblem {
  pointer?: string;
  detail: string;
}

/** RFC 9457, with the JSON pointer to what is wrong. */
export interface Problem {
  type: string;
  title: string;
  status: number;
  detail?: string;
  pointer?: string;
  errors?: FieldProblem[];
}

/** How a head's weights are computed: without steps between regions of influence, or exactly as in the paper. */
export type WeightMethod = 'smooth' | 'paper';

/** Which ways over the surface count as distances: along edges, or across triangles laid flat, too. */
export type DistanceMetric = 'edge' | 'unfolded';

export interface ParametrizationOptions {
  weights: WeightMethod;
  metric: DistanceMetric;
  /** The most vertices of each level of detail, falling; absent: what suits the head. */
  lods?: number[] | undefined;
}

export type Vector = [number, number, number];

export type Severity = 'error' | 'warning' | 'note';

export interface FindingCounts {
  errors: number;
  warnings: number;
  notes: number;
}

/** One thing the fit doctor found, with where it is. */
export interface Finding {
  code: string;
  severity: Severity;
  words: string;
  remedy: string;
  place: {
    part: number | null;
    points: string[];
    /** Vertices of the file: the first of them, and how many there are. */
    vertices: { sample: number[]; count: number };
    position: Vector | null;
  };
  measured: { what: string; value: number; threshold: number } | null;
}

/** Distance of a level from the full mesh; `of_es0` as shares of the distance of the eyes, where that is known. */
export interface LevelError {
  max: number;
  mean: number;
  of_es0: { max: number; mean: number } | null;
}

export interface FitReport {
  version: number;
  summary: FindingCounts;
  findings: Finding[];
  levels_of_detail?: {
    levels: { lod: number; neutral: LevelError; expressions: Record<string, LevelError> }[];
    /** Levels that were asked for and are not there, or not as small as asked. */
    missed: { budget: number; words: string }[];
  };
}

export type ModelState = 'importing' | 'ready' | 'parametrized' | 'failed';

export type LengthUnit = 'm' | 'dm' | 'cm' | 'mm' | 'in';
/** Along an axis of the model file. */
export type Direction = '+X' | '-X' | '+Y' | '-Y' | '+Z' | '-Z';

/** How a head stands in its file, what one unit of its coordinates is, and what told it. */
export interface ModelFrame {
  unit: LengthUnit;
  metres_per_unit: number;
  axes: { up: Direction; front: Direction };
  by_user: { unit: boolean; axes: boolean };
  sure: { unit: boolean; axes: boolean };
  reasons: string[];
}

/** What a person says of a frame; null takes it back to what is guessed. */
export interface FrameWish {
  unit?: LengthUnit | null;
  up?: Direction | null;
  front?: Direction | null;
}

export type PartRole =
  'skin' | 'left_eye' | 'right_eye' | 'upper_teeth' | 'lower_teeth' | 'tongue' | 'attached' | 'rest';

export interface ModelPart {
  index: number;
  name: string;
  role: PartRole;
  /** Said by a person; otherwise guessed. */
  role_by_user: boolean;
  vertices: number;
  triangles: number;
  bounds: { min: Vector; max: Vector };
}

export interface Artefact {
  href: string;
  sha256: string;
  bytes: number;
  content_type: string;
}

export type ArtefactName = 'mesh.drc' | 'weights' | 'rig.json' | 'face.glb';

export interface PackageLevel {
  /** 0 is the full mesh. */
  lod: number;
  vertices: number;
  triangles: number;
  artefacts: Partial<Record<ArtefactName, Artefact>>;
}

export interface FacePackage {
  parametrization: string;
  created: string;
  metric: string;
  weights: string;
  artefacts: Partial<Record<ArtefactName, Artefact>>;
  /** Absent or empty: the package has no levels but the full mesh. */
  levels?: PackageLevel[];
}

export interface Model {
  id: string;
  name: string;
  state: ModelState;
  problem: Problem | null;
  created: string;
  updated: string;
  source?: { format: string; bytes: number; sha256: string } | null;
  counts?: { vertices: number; triangles: number; parts: number } | null;
  bounds?: { min: Vector; max: Vector } | null;
  parts?: ModelPart[];
  /** Null before the import has ended, and of a head that was imported before frames were guessed. */
  frame?: ModelFrame | null;
  warnings?: string[];
  /** How much the report tells of; null before the import has ended. */
  findings?: FindingCounts | null;
  feature_point_count?: number;
  package: FacePackage | null;
}

export interface ModelPage {
  models: Model[];
  next: string | null;
}

export type JobState = 'queued' | 'running' | 'done' | 'failed' | 'cancelled';

export interface Job {
  id: string;
  kind: 'import' | 'parametrize' | 'propose' | 'extract';
  model: string;
  state: JobState;
  progress: number;
  stage: string;
  problem: Problem | null;
  /** Of proposals: how many, and why others could not be made. */
  result?: { proposed?: number; not_proposed?: Record<string, string> } | null;
}

export interface ModelAndJob {
  model: Model;
  job: Job;
}

export interface FeaturePointValue {
  vertex?: number | null;
  position?: Vector;
  /** Nobody has placed or confirmed it yet. */
  proposed?: boolean;
  method?: string;
  confidence?: 'high' | 'medium' | 'low';
  /** Share of ES0. */
  expected_error?: number;
  /** What else makes it unsure, in words. */
  remark?: string;
}

export interface FeaturePointSet {
  points: Record<string, FeaturePointValue>;
  warnings?: string[];
}

/** What is played into a stream; times in ms. */
export interface Playing {
  id: string;
  kind: string;
  name: string;
  /** null: it has no end. */
  duration: number | null;
  position: number;
  fps: number;
  loop: boolean;
  /** Of a .fap file, in the answer that it plays. */
  warnings?: string[];
}

export interface PlayWish {
  loop: boolean;
  /** Where to begin, ms. */
  from: number;
  /** From whoever sends or plays there. */
  takeOver: boolean;
}

export interface StreamInfo {
  id: string;
  title: string;
  model?: string | null;
  epoch?: string | number;
  sequence?: number;
  subscribers: number;
  publishers: number;
  source?: string;
  /** What feeds it now. */
  active_source?: 'connection' | 'request' | 'performance' | 'fap' | 'recording' | 'demo' | null;
  /** ms for which frames are gathered into one message; 0: each is sent at once. */
  batch_interval?: number;
  /** null: clients take that of the head. */
  viseme_share?: number | null;
  playing?: Playing | null;
}

/** What may be said of a stream when it is made; what is left out is as the server has it. */
export interface StreamOptions {
  batch_interval?: number;
  viseme_share?: number;
}

/** A stream on the server's disk; times in ms. */
export interface Recording {
  id: string;
  /** May be gone by now. */
  stream: string;
  name: string;
  model: string | null;
  created: string;
  state: 'recording' | 'finished' | 'broken';
  /** Why it ended; null: it runs. */
  ended: string | null;
  duration: number;
  frames: number;
  /** Frames that came faster than the disk took them. */
  lost: number;
  bytes: number;
}

export type RecordingFormat = 'performance' | 'fap' | 'arkit-csv' | 'glb' | 'frames-json';

export interface VersionInfo {
  version: string;
}
