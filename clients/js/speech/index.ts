/** The text of a stream, said by the browser's own voice. */
export { StreamSpeech, type SpeechState } from './stream_speech.ts';
