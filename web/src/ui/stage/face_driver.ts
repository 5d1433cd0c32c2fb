import type { FaceFrame, StreamClient } from '@client/index.ts';
import type { Library } from '@client/motion/index.ts';
import { ClipPlayer, type Clip } from '../../face/clip.ts';
import { IdlePlayer } from '../../face/idle_player.ts';
import type { Performer } from '../../face/performer.ts';
import { momentOf, positionOf, type SpokenClip } from '../../face/speech_clock.ts';
import { standardQuantizers, type QuantizerSteps } from '@protocol/quantizers.ts';
import { Signal } from '../shared/signal.ts';

/**
 * The source that drives the face on this page:
 * - `hand`: the frame set with the sliders; the only source under which idle life runs.
 * - `clip`: a performance document or .fap file played on this page, also while it is paused.
 * - `speech`: what the server made of a text, on the clock of its sound.
 * - `microphone`: the newest mouth that was heard.
 * - `recording`: one moment of a recording, held still.
 * - `stream`: the stream that the page subscribes to, whatever feeds it on the server.
 */
export type MotionSource = 'hand' | 'clip' | 'speech' | 'microphone' | 'recording' | 'stream';

export type DrivenFace = Pick<Performer, 'follow' | 'showBetween' | 'enliven' | 'step' | 'listen'>;

/** Calm idle life. The seed is fixed, so that each visit looks the same. */
const idleSettings = { seed: 1, blinksPerMinute: 15, head: 0.3, eyes: 0.5 };

/**
 * Decides which source moves the face. One source has the face at a time; any source may take it from any other, and the
 * one that loses it stops. A source that ends or is paused leaves the face to the hand.
 */
export class FaceDriver {
  readonly source = new Signal<MotionSource>('hand');
  private readonly listeners = new Set<(source: MotionSource) => void>();
  private face: DrivenFace | null = null;
  private twin: DrivenFace | null = null;
  /** Whether the last step changed the pose of the face of `setTwin`. */
  twinMoved = false;
  private client: StreamClient | null = null;
  private speech: SpokenClip | null = null;
  private heard: (() => FaceFrame) | null = null;
  /** The speech that had the face last, until a source takes it by an act of the user. */
  private spoken: Clip | null = null;
  private held: FaceFrame | null = null;
  /** Of the speech its position, ms, of the microphone its frame, which the faces show; null: they are to be posed anew. */
  private posedAt: number | FaceFrame | null = null;
  private idle: IdlePlayer | null = null;
  private loadIdle: (() => Promise<Library>) | null = null;

  constructor(
    /** The frame set with the sliders, which change it in place. */
    private readonly frame: FaceFrame,
    readonly clip = new ClipPlayer(),
  ) {}

  /** Calls the listener whenever a source takes the face, even if it already has the face. */
  onTake(listener: (source: MotionSource) => void): void {
    this.listeners.add(listener);
  }

  /** Shows the frame set with the sliders. */
  byHand(): void {
    this.take('hand');
    this.follow(this.frame);
  }

  /** Shows what the clip player plays or seeks. */
  byClip(): void {
    this.take('clip');
  }

  /** Shows a clip as its sound is heard. */
  bySpeech(speech: SpokenClip): void {
    this.speech = speech;
    this.take('speech');
  }

  /** Shows the newest frame of a microphone at once, without easing. */
  byMicrophone(newest: () => FaceFrame): void {
    this.heard = newest;
    this.take('microphone');
  }

  /** Shows a frame of a recording and holds it. */
  byRecording(moment: FaceFrame): void {
    this.take('recording');
    this.held = moment;
    this.follow(moment);
  }

  /** Shows the frames that the subscription receives. */
  byStream(): void {
    this.take('stream');
  }

  /** To call when a source ends or is paused: if it has the face, `hand` takes the face. */
  release(source: MotionSource): void {
    if (this.source.value !== source) return;
    const spoken = source === 'speech' ? this.shownClip : null;
    this.byHand();
    this.spoken = spoken;
  }

  /**
   * Switches idle life on, which the library that `load` gives plays, or off (null). On makes `hand` take the face; off does
   * not interrupt a clip or stream. Fails if the library cannot be loaded.
   */
  async setIdle(load: (() => Promise<Library>) | null): Promise<void> {
    this.loadIdle = load;
    const library = load ? await load() : null;
    if (this.loadIdle !== load) return; // switched meanwhile
    this.idle = library ? new IdlePlayer(library, this.frame, idleSettings) : null;
    if (library || this.source.value === 'hand' || this.source.value === 'recording') this.byHand();
  }

  /** Replaces the face or its level of detail. The current source continues, except `recording`, which ends. */
  setFace(face: DrivenFace | null): void {
    this.face = face;
    this.posedAt = null;
    face?.listen(this.client);
    face?.follow(this.frame);
    const source = this.source.value;
    if (source === 'clip') this.clip.seek(this.clip.position);
    else if (source !== 'stream' && source !== 'speech' && source !== 'microphone') this.take('hand');
  }

  /** Sets a face that does the same in a second view; null: none. */
  setTwin(twin: DrivenFace | null): void {
    this.twin = twin;
    this.posedAt = null;
    if (!twin) return;
    twin.listen(this.client);
    const source = this.source.value;
    twin.follow(source === 'recording' && this.held ? this.held : this.frame);
    if (source === 'clip') this.clip.seek(this.clip.position);
  }

  /** Sets the subscription whose frames `stream` shows; null: none. */
  setClient(client: StreamClient | null): void {
    this.client = client;
    this.face?.listen(client);
    this.twin?.listen(client);
  }

  /** The clip that is on the face, of a file or of a speech; null while another source drives it. */
  get shownClip(): Clip | null {
    const source = this.source.value;
    return source === 'clip' ? this.clip.clip : source === 'speech' ? (this.speech?.clip ?? null) : null;
  }

  /** The clip to save: that on the face, or the speech that was the last to move it. */
  get clipToSave(): Clip | null {
    return this.shownClip ?? this.spoken;
  }

  /** Whether a clip or speech moves the face now. */
  get plays(): boolean {
    return this.source.value === 'speech' || (this.source.value === 'clip' && this.clip.playing);
  }

  /** The frame that is on the face now, without idle life; of a stream, which the player shows, it is null. */
  shownFrame(): { state: FaceFrame; steps: QuantizerSteps } | null {
    const { clip } = this.clip;
    switch (this.source.value) {
      case 'clip':
        return clip ? { state: clip.momentAt(this.clip.position).from.state, steps: clip.steps } : null;
      case 'speech':
        return this.speech ? { state: momentOf(this.speech).from.state, steps: this.speech.clip.steps } : null;
      case 'microphone':
        return this.heard ? { state: this.heard(), steps: standardQuantizers } : null;
      case 'recording':
        return this.held ? { state: this.held, steps: standardQuantizers } : null;
      case 'stream':
        return null;
      case 'hand':
        return { state: this.frame, steps: standardQuantizers };
    }
  }

  /** Advances by one displayed frame, seconds. Returns whether the pose changed. */
  step(deltaSeconds: number): boolean {
    const { face, twin, clip, idle } = this;
    this.twinMoved = false;
    if (!face) return false;
    const source = this.source.value;
    const spoken = source === 'speech' ? this.speech : null;
    const posed = spoken ? positionOf(spoken) : source === 'microphone' && this.heard ? this.heard() : null;
    if (posed !== null && posed === this.posedAt) return false; // a paused speech, a silent microphone
    this.posedAt = posed;
    const moment = spoken ? momentOf(spoken) : source === 'clip' ? clip.step(deltaSeconds) : null;
    if (moment) {
      const steps = (spoken ?? clip).clip?.steps;
      face.showBetween(moment.from.state, moment.to.state, moment.t, steps);
      twin?.showBetween(moment.from.state, moment.to.state, moment.t, steps);
      this.twinMoved = twin !== null;
      return true;
    }
    if (source === 'microphone' && this.heard) {
      const frame = this.heard();
      face.showBetween(frame, frame, 0);
      twin?.showBetween(frame, frame, 0);
      this.twinMoved = twin !== null;
      return true;
    }
    if (idle && source === 'hand') {
      const frame = idle.step(deltaSeconds);
      face.enliven(frame, idle.steps);
      twin?.enliven(frame, idle.steps);
    }
    const moved = face.step(deltaSeconds, source === 'stream');
    if (twin) this.twinMoved = twin.step(deltaSeconds, source === 'stream'); // second: of a stream it shows the moment of the first
    return moved;
  }

  private follow(frame: FaceFrame): void {
    this.face?.follow(frame);
    this.twin?.follow(frame);
  }

  private take(source: MotionSource): void {
    if (source !== 'clip') this.clip.pause();
    if (source !== 'speech') this.speech = null;
    if (source !== 'microphone') this.heard = null;
    this.spoken = null;
    this.posedAt = null;
    this.source.set(source);
    for (const listener of [...this.listeners]) listener(source);
  }
}
