import { problemOf, wordsOf } from '../../net/problem.ts';
import { watchRefusal } from '../../net/reach.ts';
import { getSession, invitedToken, signIn, signOut } from '../../net/session.ts';
import type { Problem, Session } from '../../net/types.ts';
import { forgetKept } from '../../../offline/register.ts';
import { h, replace } from '../shared/dom.ts';
import { icon } from '../shared/icons.ts';
import { capital } from '../shared/names.ts';
import { t } from '../../words/words.ts';

/**
 * Lets a visitor in before the studio starts: takes the token of an invitation out of the address, and asks for one
 * where the server wants it. Resolves with the session when the server accepts requests, and with null when it does not
 * answer. `root` shows the question.
 */
export async function letIn(base: string, root: HTMLElement): Promise<Session | null> {
  const invited = invitedToken(location.hash);
  // The address must not keep the token: it is seen on the screen, and stays in the browser's history.
  if (invited !== null) history.replaceState(null, '', location.pathname + location.search);
  let reason = '';
  try {
    if (invited !== null) await signIn(base, invited);
    const session = await getSession(base);
    if (!session.asks_for_tokens || session.scope !== 'none') return session;
  } catch (error) {
    const problem = problemOf(error);
    // A server that does not answer is the studio's own message.
    if (problem.status !== 401) return null;
    reason = refusalOf(problem);
  }
  return askForToken(base, root, reason);
}

/** Forgets the token in this browser, with what `forget` does; null on a server that does not ask for one. */
export function signOutButton(base: string, session: Session | null, forget: () => void): HTMLElement | null {
  if (!session?.asks_for_tokens) return null;
  const leave = () => {
    forget();
    void Promise.allSettled([signOut(base), forgetKept()]).then(() => location.reload());
  };
  return h('button', { type: 'button', class: 'quiet sign-out', on: { click: leave } }, t('Sign out'));
}

/**
 * Says that the server does not accept the token any more, which may have expired or been revoked, and lets the visitor sign in over the
 * page as it is: nothing on it is lost. `back` is called when the server accepts requests again.
 */
export function signedOutNote(base: string, back: () => void): HTMLElement {
  const note = h('div', { class: 'signed-out-note', role: 'status', hidden: true });
  const again = async (): Promise<void> => {
    const dialog = h('dialog', { class: 'dialog', 'aria-label': t('Sign in') });
    const closed = new Promise<null>((resolve) => dialog.addEventListener('close', () => resolve(null)));
    document.body.append(dialog);
    dialog.showModal();
    const session = await Promise.race([askForToken(base, dialog, ''), closed]);
    dialog.remove();
    if (session === null) return;
    note.hidden = true;
    back();
  };
  watchRefusal(() => {
    if (!note.hidden) return;
    note.hidden = false;
    replace(
      note,
      icon('warning', 16),
      h('strong', {}, t('You are signed out: the token has expired or was revoked.')),
      ' ',
      t('What is on this page stays.'),
      ' ',
      h('button', { type: 'button', class: 'small', on: { click: () => void again() } }, t('Sign in')),
    );
  });
  return note;
}

const refusalOf = (problem: Problem): string =>
  problem.status === 401 ? t('The token is not accepted: it was never made, or is revoked.') : capital(wordsOf(problem));

function askForToken(base: string, root: HTMLElement, reason: string): Promise<Session> {
  return new Promise((resolve) => {
    const input = h('input', {
      type: 'password',
      id: 'token',
      name: 'token',
      required: true,
      maxlength: 200,
      autocomplete: 'current-password',
      spellcheck: false,
      'aria-describedby': 'token-fault',
    });
    const fault = h('p', { id: 'token-fault', class: 'sign-in-fault', role: 'alert' }, reason);
    const button = h('button', { type: 'submit', class: 'primary' }, t('Sign in'));
    const form = h(
      'form',
      {
        class: 'sign-in',
        on: {
          submit: (event: Event) => {
            event.preventDefault();
            button.disabled = true;
            signIn(base, input.value.trim()).then(
              resolve,
              (error: unknown) => {
                const problem = problemOf(error);
                fault.textContent = refusalOf(problem);
                button.disabled = false;
                input.select();
              },
            );
          },
        },
      },
      h('h1', {}, 'Semblante'),
      h('label', { for: 'token' }, t('Token')),
      input,
      fault,
      h(
        'p',
        { class: 'hint' },
        t('Whoever runs this server makes tokens with '),
        h('code', {}, 'semblante token create'),
        t('. This browser keeps it until you sign out.'),
      ),
      h('div', { class: 'row end' }, button),
    );
    root.replaceChildren(h('main', { class: 'sign-in-page' }, form));
    input.focus();
  });
}
