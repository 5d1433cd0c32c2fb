import type { CaptionsBox, StreamCaptions } from '@client/captions/index.ts';
import type { PlayoutStats } from '@client/index.ts';
import { captionsAreChosen, chooseCaptions } from '../../../kept/captions_choice.ts';
import { prepareTexts } from '../../face/runtime.ts';
import { h } from '../shared/dom.ts';
import { Signal } from '../shared/signal.ts';
import type { FaceDriver } from '../stage/face_driver.ts';
import type { LiveModel } from './live_model.ts';

/** What the followed stream says, as words on the picture, while it drives the face. */
export class LiveCaptions {
  readonly element = h('div', { class: 'live-captions' });
  readonly on = new Signal(captionsAreChosen());
  private box: CaptionsBox | null = null;
  private captions: StreamCaptions | null = null;
  private newest = 0;

  constructor(
    private readonly live: LiveModel,
    private readonly driver: FaceDriver,
    /** Of the playout of the displayed face; null without one. */
    private readonly stats: () => Readonly<PlayoutStats> | null,
    /** ms of the stream's clock that are heard; NaN: nothing is heard. */
    private readonly heard: () => number,
  ) {
    for (const signal of [this.on, live.subscriber, driver.source] as Signal<unknown>[]) signal.watch(() => void this.follow());
    this.on.watch(chooseCaptions);
  }

  private async follow(): Promise<void> {
    const number = (this.newest += 1);
    const wanted = this.on.value && this.driver.source.value === 'stream' ? this.live.subscriber.value : null;
    this.captions?.stop();
    this.captions?.dispose();
    this.captions = null;
    if (!wanted) return;
    // Fetched by those who read.
    const [{ CaptionsBox, captionsStyle, StreamCaptions }] = await Promise.all([import('@client/captions/index.ts'), prepareTexts().catch(() => undefined)]);
    if (number !== this.newest) return;
    if (!this.box) {
      const style = new CSSStyleSheet();
      style.replaceSync(captionsStyle);
      document.adoptedStyleSheets.push(style);
      this.box = new CaptionsBox();
      this.element.append(this.box.element);
    }
    const { box } = this;
    const captions = new StreamCaptions(wanted.client, () => this.shown(wanted.client.streamClock.mediaTime));
    captions.on('cue', (cue) => box.show(cue));
    captions.start();
    this.captions = captions;
    const tick = (): void => {
      if (captions !== this.captions) return box.show(null);
      box.setHeard(Number.isFinite(this.heard()));
      captions.update();
      requestAnimationFrame(tick);
    };
    tick();
  }

  private shown(clock: number): number {
    const heard = this.heard();
    return Number.isFinite(heard) ? heard : clock - (this.stats()?.delay ?? NaN);
  }
}
