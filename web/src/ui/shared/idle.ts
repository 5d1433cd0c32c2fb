import type { ToastAction, Toasts } from './toast.ts';

/** Why a button can do nothing yet, in a sentence, and what helps. */
export interface Idle {
  why: string;
  help?: ToastAction;
}

const reasons = new WeakMap<HTMLButtonElement, Idle>();

/**
 * Makes a button one that may have nothing to do: `setIdle` then says why. It stays in the order of the Tab key and answers a
 * press with the reason, since a finger sees no tooltip and a disabled button cannot be reached by keyboard.
 */
export function canIdle(button: HTMLButtonElement, toasts: Pick<Toasts, 'say'>): void {
  button.addEventListener(
    'click',
    (event) => {
      const idle = reasons.get(button);
      if (!idle) return;
      event.preventDefault(); // it may submit a form
      event.stopImmediatePropagation();
      toasts.say(idle.why, idle.help, event.detail === 0);
    },
    { capture: true },
  );
}

/** `title`: what the button does when it can; null: it can. */
export function setIdle(button: HTMLButtonElement, title: string, idle: Idle | null): void {
  if (idle) reasons.set(button, idle);
  else reasons.delete(button);
  button.title = idle ? `${title}. ${idle.why}` : title;
  if (idle) button.setAttribute('aria-disabled', 'true');
  else button.removeAttribute('aria-disabled');
}
