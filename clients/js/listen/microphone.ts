import type { Heard } from './listener.ts';
import type { HeardMessage, ListenOptions } from './worklet.ts';

/** Why a microphone is not heard. */
export type MicrophoneFault =
  /** Nobody allowed it. */
  | 'refused'
  /** There is none. */
  | 'missing'
  /** Another program has it, or the system does not give it. */
  | 'busy'
  /** The page has no microphone: it did not come by https, or the browser has no AudioWorklet. */
  | 'unsupported'
  /** A file of the listener was not loaded. */
  | 'not-loaded';

export class MicrophoneError extends Error {
  constructor(
    readonly fault: MicrophoneFault,
    message: string,
  ) {
    super(message);
    this.name = 'MicrophoneError';
  }
}

/** What is heard, with `delay`: ms from the moment of the sound, when it came into the graph, to this call. */
export type OnHeard = (heard: Heard & { delay: number }) => void;

/** The two files of a listener: the library's bytes, and the address of `listen_worklet.js`. */
export interface ListenFiles {
  library: () => Promise<BufferSource>;
  worklet: string | URL;
}

const loaded = new WeakMap<BaseAudioContext, Promise<void>>();

/** Listens to a node of the page's own graph, for one that is no microphone. Returns the function that ends it. */
export async function listenTo(source: AudioNode, files: ListenFiles, onHeard: OnHeard): Promise<() => void> {
  const { context } = source;
  let module = loaded.get(context);
  if (!module) {
    module = context.audioWorklet.addModule(files.worklet);
    loaded.set(context, module);
    module.catch(() => loaded.delete(context));
  }
  const [library] = await Promise.all([files.library().then((bytes) => WebAssembly.compile(bytes)), module]);
  const processorOptions: ListenOptions = { library };
  const node = new AudioWorkletNode(context, 'semblante-listener', {
    numberOfInputs: 1,
    numberOfOutputs: 0,
    channelCount: 1,
    channelCountMode: 'explicit',
    processorOptions,
  });
  node.port.onmessage = ({ data }: MessageEvent<HeardMessage>) => {
    onHeard({ ...data, delay: 1000 * (context.currentTime - data.at) });
  };
  source.connect(node);
  return () => {
    node.port.onmessage = null;
    source.disconnect(node);
  };
}

/** A microphone whose speech moves a mouth. */
export class Microphone {
  private endListening: () => void = () => undefined;

  private constructor(
    private readonly stream: MediaStream,
    private readonly context: AudioContext,
  ) {}

  static get isSupported(): boolean {
    return typeof AudioWorkletNode !== 'undefined' && typeof navigator !== 'undefined' && navigator.mediaDevices?.getUserMedia !== undefined;
  }

  /** Asks for the microphone and listens until `close`. Rejects with MicrophoneError. `onEnd`: it was taken away. */
  static async open(files: ListenFiles, onHeard: OnHeard, onEnd: () => void = () => undefined): Promise<Microphone> {
    if (!Microphone.isSupported) throw new MicrophoneError('unsupported', 'there is no microphone for this page: it must come by https or from localhost');
    let stream: MediaStream;
    try {
      stream = await navigator.mediaDevices.getUserMedia({ audio: { channelCount: 1, echoCancellation: true, noiseSuppression: true } });
    } catch (error) {
      throw asMicrophoneError(error);
    }
    const context = new AudioContext({ latencyHint: 'interactive' });
    const microphone = new Microphone(stream, context);
    try {
      await context.resume();
      microphone.endListening = await listenTo(context.createMediaStreamSource(stream), files, onHeard);
    } catch (error) {
      microphone.close();
      throw new MicrophoneError('not-loaded', `the listener was not loaded: ${error instanceof Error ? error.message : String(error)}`);
    }
    stream.getAudioTracks()[0]?.addEventListener('ended', onEnd);
    return microphone;
  }

  /** The track that is listened to, for whoever sends it. Ends with `close`. */
  get track(): MediaStreamTrack {
    return this.stream.getAudioTracks()[0]!;
  }

  /** Gives the microphone back. What was heard and not yet told is told no more. */
  close(): void {
    this.endListening();
    for (const track of this.stream.getTracks()) track.stop();
    if (this.context.state !== 'closed') void this.context.close();
  }
}

/** By the names of the standard: Media Capture and Streams, getUserMedia(). */
function asMicrophoneError(error: unknown): MicrophoneError {
  const name = error instanceof Error ? error.name : '';
  if (name === 'NotAllowedError' || name === 'SecurityError') return new MicrophoneError('refused', 'nobody allowed the microphone');
  if (name === 'NotFoundError' || name === 'OverconstrainedError') return new MicrophoneError('missing', 'there is no microphone');
  return new MicrophoneError('busy', 'the microphone cannot be opened: another program may have it');
}
