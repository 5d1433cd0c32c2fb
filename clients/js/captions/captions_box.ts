import type { Cue } from './cues.ts';

/** Of the line, in letters' sizes. */
const lineHeight = 1.35;
const padding = 0.3;

/**
 * Words on a picture, `--semblante-captions-room` above its lower edge; a wide picture has room for buttons beside them. Sizes follow
 * the picture, so that a cue has two lines, on a narrow one three, and the letters that the browser is set to.
 */
export const captionsStyle = `
.captions {
  position: absolute; inset: 0; container: captions / size; pointer-events: none;
  display: flex; align-items: flex-end; justify-content: center;
  font: 500 medium/${lineHeight} system-ui, sans-serif;
}
.captions > span {
  box-sizing: border-box; max-width: min(100cqi - 24px, 37em);
  margin: 0 12px calc(var(--semblante-captions-room, 12px) + env(safe-area-inset-bottom));
  padding: ${padding}em 0.7em; border-radius: 0.5em; background: rgb(14 14 16 / 0.8); color: #fff;
  font-size: clamp(1em, 1.1cqi + 1.1cqb, 1.75em);
  text-align: center; text-wrap: balance; overflow-wrap: anywhere; hyphens: auto; unicode-bidi: plaintext;
}
.captions > span:empty { visibility: hidden; }
@container captions (min-aspect-ratio: 4/3) and (min-width: 600px) {
  .captions > span { max-width: min(100cqi - 320px, 37em); margin-bottom: calc(max(12px, 3cqb) + env(safe-area-inset-bottom)); }
}
@media (forced-colors: active) { .captions > span { border: 1px solid; } }
`;

/** Shows cues. `captionsStyle` is to be in the style sheets of its root. */
export class CaptionsBox {
  readonly element = document.createElement('div');
  private readonly words = document.createElement('span');

  constructor() {
    this.element.className = 'captions';
    this.element.append(this.words);
    this.words.dir = 'auto';
    this.words.setAttribute('aria-atomic', 'true');
    this.setHeard(false);
  }

  show(cue: Cue | null): void {
    if (cue?.language) this.words.lang = cue.language;
    else this.words.removeAttribute('lang');
    this.words.textContent = cue?.text ?? '';
  }

  /** px from the lower edge that two lines take. */
  get room(): number {
    const { fontSize, marginBottom } = getComputedStyle(this.words);
    return parseFloat(marginBottom) + parseFloat(fontSize) * (2 * lineHeight + 3 * padding);
  }

  /** Whether the words are heard too: a screen reader that says them would speak over them. */
  setHeard(heard: boolean): void {
    this.words.setAttribute('aria-live', heard ? 'off' : 'polite');
  }
}
