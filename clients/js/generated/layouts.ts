// Generated from clients/runtime/semblante.h and core/kernel/semblante_kernel.h by semblante-codegen-declarations; change the
// headers, not this. Offsets of members in bytes, with the 4-byte pointers of WebAssembly. `bytes`: the whole struct.

export const frameLayout = {
  viseme1: 0,
  viseme2: 1,
  viseme_blend: 2,
  expression1: 3,
  intensity1: 4,
  expression2: 5,
  intensity2: 6,
  reserved: 7,
  fap: 8,
  bytes: 284,
} as const;

export const irisLayout = {
  axis: 0,
  pupil_radius: 12,
  iris_radius: 16,
  bend: 20,
  bytes: 24,
} as const;

export const tongueLayout = {
  origin: 0,
  left: 12,
  up: 24,
  half_width: 36,
  roll_limit: 40,
  bytes: 44,
} as const;

export const lidsLayout = {
  gaze: 0,
  slit: 12,
  opening: 16,
  gaze_share: 20,
  ball: 28,
  lift: 96,
  bytes: 100,
} as const;

export const companionLayout = {
  point: 0,
  leader: 1,
  is_choice: 2,
  reserved: 3,
  share: 4,
  bytes: 8,
} as const;

export const rigLayout = {
  viseme: 0,
  expression: 4,
  fapu: 8,
  eye_pivot: 28,
  head_pivot: 52,
  viseme_share: 64,
  iris: 68,
  tongue: 116,
  companion: 160,
  companion_count: 164,
  lip_share: 168,
  lids: 172,
  bytes: 372,
} as const;

export const poseLayout = {
  fp: 0,
  eye_rotation: 1008,
  eye_translation: 1040,
  head_rotation: 1064,
  eye_pivot: 1080,
  head_pivot: 1104,
  pupil_growth: 1116,
  tongue_roll: 1124,
  iris: 1128,
  tongue: 1176,
  lid_closure: 1220,
  lids: 1236,
  bytes: 1436,
} as const;

export const faceLayout = {
  vertex_count: 0,
  rest: 4,
  row_offsets: 8,
  row_points: 12,
  row_weights: 16,
  rigid: 20,
  turn: 24,
  bytes: 28,
} as const;

export const trianglesLayout = {
  vertex_count: 0,
  triangle_count: 4,
  corners: 8,
  joined: 12,
  bytes: 16,
} as const;

export const errorLayout = {
  where: 0,
  message: 96,
  bytes: 352,
} as const;

export const packageLayout = {
  size: 0,
  vertex_count: 4,
  positions: 8,
  mesh_sha256: 12,
  triangles: 16,
  normals: 20,
  triangle_count: 24,
  reserved: 28,
  mesh_drc: 32,
  mesh_drc_size: 36,
  weights: 40,
  weights_size: 44,
  rig_json: 48,
  rig_json_size: 52,
  bytes: 56,
} as const;

export const headOptionsLayout = {
  size: 0,
  flags: 4,
  viseme_share: 8,
  jaw_takes_lip: 12,
  bytes: 16,
} as const;

export const timedFrameLayout = {
  time: 0,
  frame: 8,
  bytes: 296,
} as const;

export const streamOptionsLayout = {
  size: 0,
  role: 4,
  take_over: 8,
  max_message_bytes: 12,
  retry_first: 16,
  retry_longest: 24,
  seed: 32,
  ping_interval: 40,
  silence_limit: 48,
  batch: 56,
  resume_epoch: 64,
  resume_sequence: 72,
  sound: 80,
  text: 84,
  captions: 88,
  reserved: 92,
  bytes: 96,
} as const;

export const eventLayout = {
  size: 0,
  type: 4,
  state: 8,
  code: 12,
  resumed: 16,
  is_final: 20,
  epoch: 24,
  sequence: 32,
  media_time: 40,
  round_trip: 48,
  server_offset: 56,
  error: 64,
  duration: 416,
  packet: 424,
  packet_size: 428,
  reserved: 432,
  text: 436,
  language: 440,
  bytes: 448,
} as const;

export const headerLayout = {
  size: 0,
  resumed: 4,
  epoch: 8,
  sequence: 16,
  media_time: 24,
  server_time: 32,
  frame_rate: 40,
  batch_interval: 48,
  viseme_share: 56,
  stream: 64,
  title: 68,
  model: 72,
  quantizer: 76,
  sound_codec: 80,
  sound_rate: 84,
  sound_channels: 88,
  sound_bitrate: 92,
  bytes: 96,
} as const;

export const clockLayout = {
  size: 0,
  steps: 4,
  media_time: 8,
  uncertainty: 16,
  drift: 24,
  round_trip: 32,
  server_offset: 40,
  bytes: 48,
} as const;

export const playerOptionsLayout = {
  size: 0,
  eased: 4,
  delay: 8,
  max_frames: 16,
  reserved: 20,
  bytes: 24,
} as const;

export const playerStatisticsLayout = {
  size: 0,
  held: 4,
  delay: 8,
  wanted_delay: 16,
  jitter: 24,
  error: 32,
  starved_time: 40,
  starved: 48,
  snaps: 56,
  bytes: 64,
} as const;

export const momentLayout = {
  size: 0,
  is_curve: 4,
  from_time: 8,
  to_time: 16,
  viseme_share: 24,
  t: 32,
  spans: 36,
  frames: 48,
  bytes: 1184,
} as const;

export const takeOptionsLayout = {
  size: 0,
  absent: 4,
  gaps: 8,
  bytes: 12,
} as const;

export const takeWarningLayout = {
  size: 0,
  oddity: 4,
  line: 8,
  count: 12,
  message: 16,
  bytes: 272,
} as const;

export const listenerOptionsLayout = {
  size: 0,
  sample_rate: 4,
  bytes: 8,
} as const;

export const heardLayout = {
  size: 0,
  level: 4,
  time: 8,
  weights: 16,
  probability: 76,
  bytes: 136,
} as const;
