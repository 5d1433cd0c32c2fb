/**
 * Colours follow the attribute `theme`, else the system; a page can set the custom properties itself. Letters follow what the browser
 * is set to, which `medium` is and a page's `rem` may not be.
 */
export const styleText = `
:host {
  --semblante-background: light-dark(#e9e5df, #17191d);
  --semblante-text: light-dark(#3a3631, #d8d5d0);
  color-scheme: light dark;
  display: block; position: relative; overflow: hidden; contain: content;
  width: 320px; height: 400px; container-type: inline-size;
  background: var(--semblante-background); color: var(--semblante-text);
  font: medium/1.45 system-ui, sans-serif;
}
:host([theme='light']) { color-scheme: light; }
:host([theme='dark']) { color-scheme: dark; }
:host([hidden]) { display: none; }
:host(:is([sound]:not([sound='false']), [voice]:not([voice='false']))) { --semblante-captions-room: 68px; }
:host(:focus-visible) { outline: 3px solid Highlight; outline-offset: -3px; }
div.stage, canvas, img { position: absolute; inset: 0; width: 100%; height: 100%; display: block; }
div.stage { touch-action: pan-y; opacity: 0; transition: opacity 0.25s; cursor: grab; }
:host([orbit='free']) .stage { touch-action: none; }
:host([orbit='none']) .stage { touch-action: auto; cursor: auto; }
div.stage.shown { opacity: 1; }
div.stage:active { cursor: grabbing; }
img { object-fit: cover; }
img.gone { display: none; }
p {
  position: absolute; inset: auto 0 0; margin: 0; padding: 0.9em 1.2em calc(0.9em + env(safe-area-inset-bottom));
  font-size: 0.9375em; text-align: center; text-wrap: balance;
}
p.alone { inset: 0; display: grid; place-content: center; max-width: 34ch; margin: auto; }
p:empty { display: none; }
button {
  position: absolute; left: 50%; bottom: calc(12px + env(safe-area-inset-bottom)); translate: -50%; min-width: 48px; min-height: 48px; padding: 0 1.4em;
  border: 0; border-radius: 24px; font: inherit; font-weight: 600; line-height: normal; cursor: pointer;
  background: light-dark(#2b2925, #f1eee9); color: light-dark(#fff, #1a1a1a);
}
button[hidden] { display: none; }
button.sound { left: 12px; translate: none; padding: 0 1.1em; font-size: 0.875em; }
@container (max-width: 559px) { :host(:is([sound]:not([sound='false']), [voice]:not([voice='false']))) button:not(.sound) { bottom: calc(68px + env(safe-area-inset-bottom)); } }
button:disabled { opacity: 0.7; cursor: default; }
i { position: absolute; left: 50%; top: 50%; width: 34px; height: 34px; margin: -17px; border-radius: 50%;
  border: 3px solid color-mix(in srgb, currentColor 25%, transparent); border-top-color: currentColor; animation: turn 0.9s linear infinite; }
i[hidden] { display: none; }
@keyframes turn { to { rotate: 1turn; } }
@media (prefers-reduced-motion: reduce) { i { animation-duration: 6s; } div.stage { transition: none; } }
`;
