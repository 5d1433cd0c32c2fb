/** Recorded and written motion, and faces of other systems: what needs no renderer. */
export { loadMotion, type Library, type MotionFunctions } from './library.ts';
export { Bridges, type Bridged, type Coefficients } from './bridges.ts';
export { Performance, restingFace, type PerformedFace } from './performance.ts';
export { readTake, writeTake, type Take, type TakeFormat, type TakeOptions, type TakeWarning } from './take.ts';
