/**
 * Offsets of members in the structs of clients/runtime/semblante.h and core/kernel/semblante_kernel.h, in bytes, with
 * pointers of 4 bytes. A test compares them with the compiler's.
 */
import { fapCount } from '../../protocol/ts/generated/mpeg4.ts';

export const frameLayout = { faps: 8, size: 8 + (fapCount + 1) * 4 } as const;

/** The size is a multiple of 8, as its time has 8 bytes. */
export const timedFrameLayout = { time: 0, frame: 8, size: 8 + Math.ceil(frameLayout.size / 8) * 8 } as const;

export const errorLayout = { where: 0, message: 96, size: 352 } as const;

export const streamOptionsLayout = {
  role: 4,
  take_over: 8,
  retry_first: 16,
  retry_longest: 24,
  seed: 32,
  ping_interval: 40,
  silence_limit: 48,
  sound: 80,
  text: 84,
  size: 88,
} as const;

export const eventLayout = {
  type: 4,
  state: 8,
  code: 12,
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
  text: 436,
  language: 440,
  size: 448,
} as const;

export const headerLayout = {
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
  size: 96,
} as const;

export const clockLayout = { steps: 4, media_time: 8, uncertainty: 16, drift: 24, round_trip: 32, server_offset: 40, size: 48 } as const;

export const playerOptionsLayout = { eased: 4, delay: 8, size: 24 } as const;

export const statisticsLayout = {
  held: 4,
  delay: 8,
  wanted_delay: 16,
  jitter: 24,
  error: 32,
  starved_time: 40,
  starved: 48,
  snaps: 56,
  size: 64,
} as const;

export const momentLayout = {
  is_curve: 4,
  from_time: 8,
  to_time: 16,
  viseme_share: 24,
  t: 32,
  spans: 36,
  frames: 48,
  size: 48 + 4 * frameLayout.size,
} as const;

export const takeOptionsLayout = { absent: 4, gaps: 8, size: 12 } as const;

export const takeWarningLayout = { oddity: 4, line: 8, count: 12, message: 16, size: 272 } as const;

export const listenerOptionsLayout = { sample_rate: 4, size: 8 } as const;

export const heardLayout = { level: 4, time: 8, weights: 16, probability: 76, size: 136 } as const;
