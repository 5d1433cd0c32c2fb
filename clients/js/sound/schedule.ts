import type { SoundPacket } from '../stream_types.ts';

/** ms between the decision that a packet is heard and the moment: what the browser needs */
const lead = 15;
/** ms; a packet that comes later than this is left out, as its face is over */
const latest = 500;
/** ms; media times are whole, so packets without a gap may seem to have one of this size */
export const rounding = 2;
/** The sound is heard slower or faster by at most this share, which is not noticed in speech. */
const mostStretch = 0.01;
/** ms in which an error is corrected, within that share */
const correctionTime = 2000;
/** An error counts as the mean over about so many packets: the clock of the output advances by whole blocks. */
const smoothing = 16;
/** ms; sound that is earlier than the face by more than this has a gap: the face has no frames to follow it. */
const mostAhead = 40;

/** A packet, or what is left of it to be heard. */
interface Span {
  /** media times */
  begin: number;
  end: number;
  /** output times */
  from: number;
  to: number;
}

/** Where a packet is heard: output time, ms. */
export interface Placed {
  at: number;
  /** Whole samples; the packet's own, unless the sound is brought back to the face. */
  samples: number;
}

/**
 * When the packets of a stream's sound are heard, and so the media time that the face shows with them. Times in ms: *media
 * time* is the stream's, *output time* is that of the samples of the output. Packets without a gap are heard without
 * a gap. After a pause, and when a packet comes too late for that, the sound begins again at the delay of the frames, or as
 * soon as it can; the face follows it. While the sound goes on it is brought back to that delay by a slightly other speed, since
 * the clock of the output runs faster or slower than the stream's, and the delay of the frames changes.
 */
export class SoundSchedule {
  /** What is to be heard, by increasing time. */
  private spans: Span[] = [];
  /** How much later than planned the face would show what is heard, ms: smoothed. */
  private error = 0;

  /** `rate`: samples a second of the output */
  constructor(private readonly rate = 48_000) {}

  /**
   * Null: the packet is not heard. `shown` is the media time that the face shows without sound when the sample of the output time
   * `now` is heard; NaN: unknown.
   */
  place({ mediaTime, duration }: Pick<SoundPacket, 'mediaTime' | 'duration'>, now: number, shown: number): Placed | null {
    this.forget(now);
    const last = this.spans.at(-1);
    if (last && mediaTime < last.end - rounding) return null;
    const wanted = mediaTime + now - shown;
    const samples = Math.round((duration * this.rate) / 1000);
    if (last && mediaTime <= last.end + rounding && last.to >= now + lead) {
      if (!Number.isNaN(wanted)) this.error += (wanted - last.to - this.error) / smoothing;
      if (this.error <= mostAhead) {
        const stretch = Math.min(Math.max(this.error / correctionTime, -mostStretch), mostStretch);
        return this.add(mediaTime, duration, last.to, samples + Math.round(samples * stretch));
      }
    }
    if (Number.isNaN(wanted) || now + lead - wanted > latest) return null;
    this.error = 0;
    return this.add(mediaTime, duration, Math.max(wanted, now + lead, last?.to ?? -Infinity), samples);
  }

  /** The media time of an output time; NaN: silence. */
  heardAt(now: number): number {
    this.forget(now);
    const [first] = this.spans;
    if (!first || now < first.from) return NaN;
    return first.begin + ((now - first.from) / (first.to - first.from)) * (first.end - first.begin);
  }

  clear(): void {
    this.spans = [];
  }

  private add(mediaTime: number, duration: number, at: number, samples: number): Placed {
    this.spans.push({ begin: mediaTime, end: mediaTime + duration, from: at, to: at + (samples * 1000) / this.rate });
    return { at, samples };
  }

  private forget(now: number): void {
    while (this.spans.length > 0 && now >= this.spans[0]!.to) this.spans.shift();
  }
}
