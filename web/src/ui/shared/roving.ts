/**
 * Makes the controls of a list, grid or toolbar one stop of the Tab key: the arrow keys, Home and End move between them. The stop
 * is the control that had the focus last, else the pressed or current one, else the first. `selector` names the controls; they
 * may come and go.
 */
export function rove(container: HTMLElement, selector: string): void {
  let last: string | null = null; // `data-focus` of the control that had the focus, which survives a redraw
  const shown = (): HTMLElement[] =>
    [...container.querySelectorAll<HTMLElement>(selector)].filter((one) => one.getClientRects().length > 0 && !one.matches(':disabled'));
  const settle = (): void => {
    const all = [...container.querySelectorAll<HTMLElement>(selector)];
    const usable = all.filter((one) => !one.hidden && !one.matches(':disabled'));
    const stop =
      usable.find((one) => one === document.activeElement) ??
      usable.find((one) => last !== null && one.dataset['focus'] === last) ??
      usable.find((one) => one.matches('[aria-pressed=true], [aria-current=true]')) ??
      usable[0];
    for (const one of all) one.tabIndex = one === stop ? 0 : -1;
  };
  container.addEventListener('focusin', (event) => {
    const one = (event.target as Element).closest<HTMLElement>(selector);
    if (!one) return;
    last = one.dataset['focus'] ?? null;
    settle();
  });
  container.addEventListener('keydown', (event) => {
    const from = (event.target as Element).closest<HTMLElement>(selector);
    if (!from || event.ctrlKey || event.metaKey || event.altKey || event.shiftKey) return;
    const to = target(event.key, from, shown());
    if (to === undefined) return;
    event.preventDefault();
    to?.focus();
  });
  const watched = ['hidden', 'disabled', 'aria-pressed', 'aria-current'];
  new MutationObserver(settle).observe(container, { childList: true, subtree: true, attributes: true, attributeFilter: watched });
  settle();
}

/** Where a key leads from a control: null when there is none in that direction, undefined when the key does not move. */
function target(key: string, from: HTMLElement, all: readonly HTMLElement[]): HTMLElement | null | undefined {
  const at = all.indexOf(from);
  switch (key) {
    case 'ArrowRight':
      return all[at + 1] ?? null;
    case 'ArrowLeft':
      return all[at - 1] ?? null;
    case 'Home':
      return all[0] ?? null;
    case 'End':
      return all[all.length - 1] ?? null;
    case 'ArrowDown':
      return nextRow(from, all, 1);
    case 'ArrowUp':
      return nextRow(from, all, -1);
    default:
      return undefined;
  }
}

/** The nearest control of the row below (`way` 1) or above (-1). */
function nextRow(from: HTMLElement, all: readonly HTMLElement[], way: 1 | -1): HTMLElement | null {
  const box = from.getBoundingClientRect();
  let best: HTMLElement | null = null;
  let least = Infinity;
  for (const one of all) {
    const other = one.getBoundingClientRect();
    const gap = way > 0 ? other.top - box.bottom : box.top - other.bottom;
    if (gap < -1) continue;
    // The row counts before the column.
    const distance = gap * 10 + Math.abs(other.left + other.width / 2 - box.left - box.width / 2);
    if (distance < least) {
      least = distance;
      best = one;
    }
  }
  return best;
}
