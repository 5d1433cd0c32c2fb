import { Bridges, type Library } from '@client/motion/index.ts';
import { Microphone, MicrophoneError, type ListenFiles, type MicrophoneFault, type OnHeard } from '@client/listen/index.ts';
import type { OnPacket, VoiceEncoder } from '../../net/voice_encoder.ts';
import { copyFrame, sameFrame, type FaceFrame } from '@protocol/face_frame.ts';
import { messageOf } from '../shared/message_of.ts';
import { Signal } from '../shared/signal.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import { t } from '../../words/words.ts';

export type MicrophoneState =
  | { kind: 'off' }
  | { kind: 'asking' }
  | { kind: 'on' }
  | { kind: 'failed'; message: string };

const files: ListenFiles = {
  library: async () => {
    const response = await fetch('./semblante_listen.wasm');
    if (!response.ok) throw new Error(`status ${response.status}`);
    return response.arrayBuffer();
  },
  worklet: './listen_worklet.js',
};

/** ms; the listener hears every 10. */
const leastInterval = 15;

/**
 * The mouth of who speaks into the microphone. The viseme that is heard is also that of the frame set with the sliders, so that
 * the Live tab publishes it, and an expression set by hand stays. The voice stays in the page unless it is sent on purpose.
 */
export class MicrophoneModel {
  readonly state = new Signal<MicrophoneState>({ kind: 'off' });
  /** Whether the voice goes with the mouth. Off whenever the microphone begins. */
  readonly sendsVoice = new Signal(false);
  /** Why the voice cannot be sent; null: it can. */
  readonly voiceFault = new Signal<string | null>(
    canEncode() ? null : t('This browser cannot send the voice: it has no encoder for it here.'),
  );
  /** ms from a moment of the sound to its frame: of the newest. */
  delay = NaN;
  private microphone: Microphone | null = null;
  private encoder: VoiceEncoder | null = null;
  private shown: FaceFrame;
  private newest = 0;

  constructor(
    private readonly frame: FaceFrame,
    private readonly driver: FaceDriver,
    private readonly load: () => Promise<Library>,
    /** The frame has changed; `time`: the moment of the sound that it shows, by performance.now(). */
    private readonly onChange: (time?: number) => void,
    /** Takes the packets of the voice while it is sent. */
    private readonly onPacket: OnPacket,
  ) {
    this.shown = copyFrame(frame);
    driver.onTake((source) => {
      if (source !== 'microphone') this.stop();
    });
  }

  async start(): Promise<void> {
    const number = (this.newest += 1);
    this.state.set({ kind: 'asking' });
    try {
      const bridges = this.load().then((library) => new Bridges(library));
      bridges.catch(() => undefined); // it is awaited below
      let hear: OnHeard = () => undefined;
      const microphone = await Microphone.open(
        files,
        (heard) => hear(heard),
        () => this.stop(),
      );
      if (number !== this.newest) return microphone.close();
      this.microphone = microphone;
      const bridge = await bridges;
      if (number !== this.newest) return; // stop() has closed it
      hear = this.follower(bridge);
      this.driver.byMicrophone(() => this.shown);
      this.state.set({ kind: 'on' });
    } catch (error) {
      if (number !== this.newest) return;
      this.stop();
      this.state.set({ kind: 'failed', message: error instanceof MicrophoneError ? wordsOf(error.fault) : messageOf(error) });
    }
  }

  stop(): void {
    if (this.state.value.kind === 'off' || this.state.value.kind === 'failed') return;
    this.newest += 1;
    this.microphone?.close();
    this.microphone = null;
    void this.sendVoice(false);
    Object.assign(this.frame.viseme, { select1: 0, select2: 0, blend: 0 });
    this.onChange();
    this.state.set({ kind: 'off' });
    this.driver.release('microphone');
  }

  /** Lets the voice go with the mouth, or not, while the microphone is on. */
  async sendVoice(on: boolean): Promise<void> {
    const { microphone } = this;
    this.encoder?.close();
    this.encoder = null;
    this.sendsVoice.set(on && microphone !== null);
    if (!this.sendsVoice.value || !microphone) return;
    const fail = (error: unknown): void => {
      void this.sendVoice(false);
      this.voiceFault.set(t('The voice cannot be sent: {reason}', { reason: messageOf(error) }));
    };
    try {
      // What encodes is fetched by those who send.
      const { VoiceEncoder } = await import('../../net/voice_encoder.ts');
      if (this.microphone !== microphone || !this.sendsVoice.value || this.encoder) return;
      this.encoder = new VoiceEncoder(microphone.track, this.onPacket, fail);
    } catch (error) {
      fail(error);
    }
  }

  private follower(bridges: Bridges): OnHeard {
    let before = -Infinity;
    return ({ time, weights, delay }) => {
      if (time - before < leastInterval) return;
      before = time;
      this.delay = delay;
      Object.assign(this.frame.viseme, bridges.fromOculus(weights).frame.viseme);
      // A frame that is shown is not changed; the same one again is not drawn anew.
      if (!sameFrame(this.shown, this.frame)) this.shown = copyFrame(this.frame);
      this.onChange(performance.now() - delay);
    };
  }
}

/** Whether this browser codes Opus and gives pages the samples of a microphone. */
function canEncode(): boolean {
  return typeof AudioEncoder === 'function' && typeof (globalThis as { MediaStreamTrackProcessor?: unknown }).MediaStreamTrackProcessor === 'function';
}

function wordsOf(fault: MicrophoneFault): string {
  switch (fault) {
    case 'refused':
      return t('The microphone was not allowed. Allow it for this page in the browser, then try again.');
    case 'missing':
      return t('There is no microphone.');
    case 'busy':
      return t('The microphone cannot be opened: another program may have it.');
    case 'unsupported':
      return t('There is no microphone for this page: it must come by https or from localhost.');
    case 'not-loaded':
      return t('The listener was not loaded.');
  }
}
