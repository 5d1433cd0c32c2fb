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

/** Takes the answer to a request, or null when there was none. */
export function noteAnswer(response: Response | null): void {
  const now = response !== null && !response.headers.has(keptHeader);
  if (now === reached) return;
  reached = now;
  for (const listener of listeners) listener(now);
}

/** Asks the server whether it is there. */
export async function tryServer(base: string): Promise<void> {
  noteAnswer(await fetch(`${base}/healthz`, { cache: 'no-store' }).catch(() => null));
}
