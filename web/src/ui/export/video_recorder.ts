import type { Stage } from '../../view/stage.ts';
import type { Signal } from '../shared/signal.ts';
import { t } from '../../words/words.ts';

/** Of these the first that the browser can write; opus and VP9 where there is a choice. */
const formats = ['video/webm;codecs=vp9,opus', 'video/webm;codecs=vp8,opus', 'video/webm'];
const framesPerSecond = 30;
/** How often it is looked whether the playback has ended, ms. */
const lookInterval = 100;

/** Records the canvas, and the sound of the page and of the followed stream where there is one, as WebM. */
export class VideoRecorder {
  private isRunning = false;
  private recorder: MediaRecorder | null = null;
  private soundtrack: MediaStreamTrack | null = null;
  private added: AudioNode | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly sound: HTMLAudioElement,
    /** What is heard of the followed stream. */
    private readonly streamed: Signal<AudioNode | null>,
  ) {}

  get running(): boolean {
    return this.isRunning;
  }

  /**
   * Records until `stop`, or until `plays` is no longer true after it was. Resolves with the video. Call on a click: a browser
   * lets no page use its sound otherwise.
   */
  async record(plays: () => boolean): Promise<Blob> {
    const { canvas } = this.stage;
    const type = formats.find((format) => globalThis.MediaRecorder?.isTypeSupported(format));
    if (type === undefined || !canvas.captureStream) throw new Error(t('This browser cannot record videos.'));
    const sound = this.soundOfPage();
    this.isRunning = true;
    this.stage.setBackdrop(getComputedStyle(document.documentElement).getPropertyValue('--stage-inner').trim());
    this.stage.holdSize(true);
    let played = false;
    const watch = setInterval(() => {
      if (plays()) played = true;
      else if (played) this.stop();
    }, lookInterval);
    try {
      await drawnFrames(2); // the first picture of the video has the backdrop
      const stream = new MediaStream([...canvas.captureStream(framesPerSecond).getVideoTracks(), sound]);
      const content = await this.contentOf((this.recorder = new MediaRecorder(stream, { mimeType: type })));
      for (const track of stream.getVideoTracks()) track.stop();
      return content;
    } finally {
      clearInterval(watch);
      this.recorder = null;
      this.isRunning = false;
      this.stage.holdSize(false);
      this.stage.setBackdrop(null);
    }
  }

  private contentOf(recorder: MediaRecorder): Promise<Blob> {
    const parts: Blob[] = [];
    return new Promise((resolve, reject) => {
      recorder.addEventListener('dataavailable', ({ data }) => parts.push(data));
      recorder.addEventListener('error', () => reject(new Error(t('This browser cannot record videos.'))));
      recorder.addEventListener('stop', () => resolve(new Blob(parts, { type: 'video/webm' })));
      recorder.start();
      this.stage.invalidate(); // a face at rest is drawn, and so recorded, once
    });
  }

  stop(): void {
    if (this.recorder?.state === 'recording') this.recorder.stop();
  }

  /** The sound of the page as a track; silent while nothing is heard. An element can be tapped once only. */
  private soundOfPage(): MediaStreamTrack {
    if (!this.soundtrack) {
      const context = new AudioContext();
      const source = context.createMediaElementSource(this.sound);
      const tap = context.createMediaStreamDestination();
      source.connect(context.destination);
      source.connect(tap);
      this.soundtrack = tap.stream.getAudioTracks()[0]!;
      this.streamed.watch((output) => this.addStreamed(output, tap));
      void context.resume();
    }
    return this.soundtrack;
  }

  /** Another context has the sound of a stream, which nodes cannot leave, but tracks can. */
  private addStreamed(output: AudioNode | null, tap: AudioNode): void {
    this.added?.disconnect();
    this.added = null;
    if (!output) return;
    const bridge = new MediaStreamAudioDestinationNode(output.context as AudioContext);
    output.connect(bridge);
    this.added = new MediaStreamAudioSourceNode(tap.context as AudioContext, { mediaStream: bridge.stream });
    this.added.connect(tap);
  }
}

async function drawnFrames(count: number): Promise<void> {
  for (let i = 0; i < count; i += 1) await new Promise((next) => requestAnimationFrame(next));
}
