import { Runtime, type Memory, type ModuleSource } from '../runtime.ts';

/** The functions of libsemblante for takes, performances and bridges. */
export interface MotionFunctions extends Memory {
  semblante_frame_from_arkit(coefficients: number, frame: number, error: number): number;
  semblante_arkit_from_frame(frame: number, coefficients: number): number;
  semblante_frame_from_oculus(weights: number, frame: number, error: number): number;
  semblante_oculus_from_frame(frame: number, weights: number): number;
  semblante_arkit_name(shape: number): number;
  semblante_oculus_name(viseme: number): number;

  semblante_performance_create(json: number, size: number, performance: number, error: number): number;
  semblante_performance_destroy(performance: number): void;
  semblante_performance_name(performance: number): number;
  semblante_performance_duration(performance: number): number;
  semblante_performance_frame_at(performance: number, ms: number, idleMs: number, frame: number): number;

  semblante_take_read(format: number, text: number, size: number, options: number, take: number, error: number): number;
  semblante_take_destroy(take: number): void;
  semblante_take_frames(take: number, count: number): number;
  semblante_take_frame_rate(take: number): number;
  semblante_take_warning_count(take: number): number;
  semblante_take_get_warning(take: number, index: number, warning: number): number;
  semblante_take_write(
    format: number,
    frames: number,
    count: number,
    rate: number,
    text: number,
    size: number,
    error: number,
  ): number;
}

/** The part of libsemblante that has them: `semblante_motion.wasm`. */
export type Library = Runtime<MotionFunctions>;

let loading: Promise<Library> | null = null;

/** The page's instance of it, made once; after a failure the next call tries again. */
export function loadMotion(source: () => ModuleSource): Promise<Library> {
  loading ??= Runtime.open<MotionFunctions>(source()).catch((error: unknown) => {
    loading = null;
    throw error;
  });
  return loading;
}
