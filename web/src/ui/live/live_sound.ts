import type { StreamSound } from '@client/sound/index.ts';
import type { PlayoutStats } from '@client/index.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import { messageOf } from '../shared/message_of.ts';
import { Signal } from '../shared/signal.ts';
import type { LiveModel } from './live_model.ts';
import { t } from '../../words/words.ts';

/** Lets the followed stream be heard while it drives the face. */
export class LiveSound {
  /** Why nothing can be heard; null: something can. */
  readonly fault = new Signal<string | null>(null);
  /** What is heard of the stream, for whoever records it; null before something can be. */
  readonly output = new Signal<AudioNode | null>(null);
  private sound: StreamSound | null = null;
  private newest = 0;

  /** `stats`: of the playout of the displayed face; null without one. */
  constructor(
    private readonly live: LiveModel,
    private readonly driver: FaceDriver,
    private readonly stats: () => Readonly<PlayoutStats> | null,
  ) {
    let newest = Promise.resolve();
    live.untilHeard = () => newest;
    live.subscriber.watch(() => (newest = this.follow()));
    for (const signal of [live.sound, driver.source] as Signal<unknown>[])
      signal.watch(() => {
        const before = newest;
        newest = Promise.all([before, this.play()]).then(() => undefined);
      });
  }

  /** The media time that is heard, ms, for the clock of the face; NaN while nothing is heard. */
  get mediaTime(): number {
    return this.sound?.mediaTime ?? NaN;
  }

  private async follow(): Promise<void> {
    const number = (this.newest += 1);
    this.sound?.dispose();
    this.sound = null;
    this.output.set(null);
    const subscriber = this.live.subscriber.value;
    if (!subscriber?.hasSound) return;
    try {
      // What decodes and plays is fetched by those who listen.
      const { StreamSound } = await import('@client/sound/index.ts');
      if (number !== this.newest) return;
      if (!StreamSound.isSupported) throw new Error(t('This browser plays no sound of streams here: it needs https or localhost.'));
      const { stats } = this;
      this.sound = new StreamSound(subscriber.client, {
        get stats() {
          return stats() ?? silent;
        },
      });
      await this.play();
    } catch (error) {
      this.fail(error);
    }
  }

  /** Plays if it is to be heard, else is silent. */
  private async play(): Promise<void> {
    const { sound } = this;
    if (!sound) return;
    try {
      if (this.live.sound.value && this.driver.source.value === 'stream') await sound.start();
      else await sound.stop();
      if (sound === this.sound) this.output.set(sound.output);
      this.fault.set(null);
    } catch (error) {
      this.fail(error);
    }
  }

  private fail(error: unknown): void {
    this.fault.set(messageOf(error));
    this.live.sound.set(false);
  }
}

/** Without a face there is no time at which something is to be heard. */
const silent = { delay: NaN, clock: null };
