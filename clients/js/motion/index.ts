/** Recorded and written motion, and faces of other systems: what needs the whole library, and no renderer. */
export { loadWhole, type Library, type MotionFunctions } from './library.ts';
export { Bridges, type Bridged, type Coefficients } from './bridges.ts';
export { Performance, type PerformedFace } from './performance.ts';
export { readTake, writeTake, type Take, type TakeFormat, type TakeOptions, type TakeWarning } from './take.ts';
