import { adviceFor, wordsOf } from '../../net/problem.ts';
import type { Problem } from '../../net/types.ts';
import { h } from './dom.ts';
import { withShortSizes } from './format.ts';
import { icon } from './icons.ts';
import { capital } from './names.ts';
import { t } from '../../words/words.ts';

export interface ToastAction {
  label: string;
  act: () => void;
}

/** Temporary messages at the bottom of the page. Errors stay until closed. */
export class Toasts {
  readonly element = h('div', { class: 'toasts', role: 'region', 'aria-label': t('Messages'), 'aria-live': 'polite' });

  /** `action`: what a button beside the text does; there is more time for it. `focus`: the button gets the focus. */
  say(text: string, action?: ToastAction, focus = false): void {
    const toast = this.show('note', icon('check'), h('p', {}, text));
    if (action) {
      const click = (): void => {
        toast.remove();
        action.act();
      };
      const button = h('button', { type: 'button', class: 'small', on: { click } }, action.label);
      toast.append(button);
      if (focus) button.focus();
    }
    setTimeout(() => toast.remove(), action ? 10_000 : 4000);
  }

  /** `action`: what a button below the text does, in place of advice. Returns what takes the message away. */
  problem(what: string, problem: Problem, action?: ToastAction): () => void {
    const advice = action ? null : adviceFor(problem);
    // A fault of the whole file needs no place: the title names the file.
    const place = problem.pointer && problem.pointer !== '/file' ? problem.pointer : null;
    const detail = withShortSizes(wordsOf(problem));
    const click = (): void => {
      toast.remove();
      action?.act();
    };
    const toast = this.show(
      'error',
      icon('warning'),
      h(
        'div',
        {},
        h('strong', {}, what),
        h('p', {}, place ? [h('code', {}, place), ' '] : null, place ? detail : capital(detail)),
        advice ? h('p', { class: 'advice' }, advice) : null,
        action ? h('button', { type: 'button', class: 'small', on: { click } }, action.label) : null,
      ),
    );
    // What a press of its button would do has not been done when the server is back.
    if (problem.status === 0 && !action) toast.classList.add('no-answer');
    return () => toast.remove();
  }

  /** The server answers again: what could not reach it can be tried again. */
  serverIsBack(): void {
    for (const old of this.element.querySelectorAll('.no-answer')) old.remove();
  }

  private show(kind: 'note' | 'error', ...content: Node[]): HTMLElement {
    // A repeated failure replaces its earlier message.
    for (const old of this.element.querySelectorAll(`.toast-${kind}`)) {
      if (old.querySelector('strong, p')?.textContent === content[1]?.firstChild?.textContent) old.remove();
    }
    const toast = h('div', { class: `toast toast-${kind}`, role: kind === 'error' ? 'alert' : 'status' }, ...content);
    if (kind === 'error') {
      toast.append(
        h(
          'button',
          { class: 'quiet square', 'aria-label': t('Close message'), on: { click: () => toast.remove() } },
          icon('close', 16),
        ),
      );
    }
    this.element.append(toast);
    while (this.element.childElementCount > 4) this.element.firstElementChild?.remove();
    return toast;
  }
}
