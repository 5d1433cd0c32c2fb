/** The control that had the focus, and where it stood: its number among the controls of its kind in each element around it. */
interface Used {
  control: HTMLElement;
  name: string | null;
  places: { around: Element; number: number }[];
}

const nameOf = (control: Element): string | null => control.getAttribute('data-focus') ?? control.getAttribute('aria-label') ?? control.textContent;

const isDisabled = (control: Element): boolean => control.matches(':disabled');

const sameKind = (around: Element, control: Element): HTMLElement[] =>
  [...around.querySelectorAll<HTMLElement>(control.tagName)].filter((one) => one.checkVisibility());

function whereItStands(control: HTMLElement, page: Element): Used {
  const places: Used['places'] = [];
  for (let around = control.parentElement; around && page.contains(around); around = around.parentElement)
    places.push({ around, number: sameKind(around, control).indexOf(control) });
  return { control, name: nameOf(control), places };
}

/** The control of the same name in the nearest element that is still there, else the one that has come to its place. */
function successor({ control, name, places }: Used): HTMLElement | undefined {
  for (const { around, number } of places) {
    const others = around.isConnected ? sameKind(around, control) : [];
    const found = others.find((one) => nameOf(one) === name) ?? others[Math.min(number, others.length - 1)];
    if (found) return found;
  }
  return undefined;
}

/**
 * Keeps the focus in its place when the control that has it is removed: by what it did itself, as a deletion, by a list that is drawn
 * again, also behind a dialog, which gives the focus back to what opened it. Else it would go to the beginning of the page. While the
 * successor is disabled the focus waits for it.
 */
export function keepFocus(page: HTMLElement): void {
  let used: Used | null = null;
  const isSeen = (control: HTMLElement): boolean => control.isConnected && control.checkVisibility();
  page.addEventListener('focusin', ({ target }) => (used = whereItStands(target as HTMLElement, page)));
  // Whoever leaves a control that can still be used has gone by a click beside it. One that is being removed is asked when it has been.
  page.addEventListener('focusout', ({ relatedTarget }) => {
    const left = used;
    queueMicrotask(() => {
      if (left && left === used && !relatedTarget && isSeen(left.control) && !isDisabled(left.control)) used = null;
    });
  });
  const follow = (): void => {
    if (!used || document.activeElement !== document.body || isSeen(used.control)) return;
    const next = successor(used);
    if (next && !isDisabled(next)) next.focus({ preventScroll: true });
  };
  new MutationObserver(follow).observe(document.body, { childList: true, subtree: true, attributeFilter: ['disabled', 'hidden'] });
}
