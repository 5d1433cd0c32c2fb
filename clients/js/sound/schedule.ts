import type { SoundPacket } from '../stream_client.ts';

/** ms between the decision that a packet is heard and the moment: what the browser needs */
const lead = 15;
/** ms; a packet that comes later than this is left out, as its face is over */
const latest = 500;
/** ms; media times are whole, so packets without a gap may seem to have one of this size */
const rounding = 2;

interface Span {
  begin: number;
  end: number;
  /** output time minus media time */
  offset: number;
}

/**
 * When the packets of a stream's sound are heard, and so the media time that the face shows with them. Times in ms: *media
 * time* is the stream's, *output time* is that of what comes out of the loudspeaker. Packets without a gap are heard
 * without a gap; after a pause the sound begins again at the delay of the frames. A packet that is late begins as soon as it
 * can, and the face follows it.
 */
export class SoundSchedule {
  /** What is to be heard, by increasing time: more than one while a pause between them is still to come. */
  private spans: Span[] = [];

  /**
   * The output time at which the packet begins; NaN: it is not heard. `shown` is the media time that the face shows at the
   * output time `now` without sound.
   */
  place({ mediaTime, duration }: Pick<SoundPacket, 'mediaTime' | 'duration'>, now: number, shown: number): number {
    this.forget(now);
    const last = this.spans.at(-1);
    const follows = last !== undefined && Math.abs(mediaTime - last.end) <= rounding;
    if (last && !follows && mediaTime < last.end) return NaN;
    let offset = follows ? last.offset : now - shown;
    if (Number.isNaN(offset)) return NaN;
    // Not before what is being heard has ended.
    if (last && !follows) offset = Math.max(offset, last.end + last.offset - mediaTime);
    const late = now + lead - (mediaTime + offset);
    if (late > latest) return NaN;
    if (late > 0) offset += late;
    if (follows && late <= 0) last.end = mediaTime + duration;
    else this.spans.push({ begin: mediaTime, end: mediaTime + duration, offset });
    return mediaTime + offset;
  }

  /** The media time that is heard at an output time; NaN in silence. */
  heardAt(now: number): number {
    this.forget(now);
    const [first] = this.spans;
    if (!first) return NaN;
    const mediaTime = now - first.offset;
    return mediaTime >= first.begin ? mediaTime : NaN;
  }

  clear(): void {
    this.spans = [];
  }

  private forget(now: number): void {
    while (this.spans.length > 0 && now >= this.spans[0]!.end + this.spans[0]!.offset) this.spans.shift();
  }
}
