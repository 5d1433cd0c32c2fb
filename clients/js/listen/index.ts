/** Visemes of the sound of speech, in a browser or in Node. */
export { Listener, type Heard } from './listener.ts';
export { listenTo, Microphone, MicrophoneError, type ListenFiles, type MicrophoneFault, type OnHeard } from './microphone.ts';
