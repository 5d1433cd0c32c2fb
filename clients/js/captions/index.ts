/** What a stream says, as words on the picture. */
export { CaptionsBox, captionsStyle } from './captions_box.ts';
export type { Cue } from './cues.ts';
export { StreamCaptions } from './stream_captions.ts';
