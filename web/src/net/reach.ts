import { keptHeader } from '../../offline/kept_header.ts';

type Listener = (reached: boolean) => void;
const listeners = new Set<Listener>();
let reached = true;

/** Whether the last request reached the server. */
export const serverReached = (): boolean => reached;

export function watchReach(listener: Listener): void {
  listeners.add(listener);
  listener(reached);
}

const refusedListeners = new Set<() => void>();

/** `listener` is called when the server does not accept the token of this browser any more. */
export function watchRefusal(listener: () => void): void {
  refusedListeners.add(listener);
}

/** Takes the answer to a request, or null when there was none. */
export function noteAnswer(response: Response | null): void {
  if (response?.status === 401) for (const listener of refusedListeners) listener();
  const now = response !== null && !response.headers.has(keptHeader);
  if (now === reached) return;
  reached = now;
  for (const listener of listeners) listener(now);
}

/** Asks the server whether it is there. */
export async function tryServer(base: string): Promise<void> {
  noteAnswer(await fetch(`${base}/healthz`, { cache: 'no-store' }).catch(() => null));
}
