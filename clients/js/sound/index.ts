/** The sound of a stream, in a browser. */
export { StreamSound } from './stream_sound.ts';
export { SoundSchedule } from './schedule.ts';
