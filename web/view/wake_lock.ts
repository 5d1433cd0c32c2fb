/** Seconds between looks at whether the screen shall stay on. */
const period = 2;

/** Keeps the screen on while `wanted` holds and the page is seen. Browsers without the interface, and without TLS, let it dim. */
export function stayAwake(wanted: () => boolean): void {
  if (!('wakeLock' in navigator)) return;
  let lock: WakeLockSentinel | null = null;
  let asking = false;
  const look = async (): Promise<void> => {
    if (asking || document.visibilityState === 'hidden') return; // a hidden page has lost its lock
    const wish = wanted();
    if (wish === (lock !== null && !lock.released)) return;
    asking = true;
    try {
      if (wish) lock = await navigator.wakeLock.request('screen');
      else {
        await lock?.release();
        lock = null;
      }
    } catch {
      // The battery is low, or a policy forbids it.
    } finally {
      asking = false;
    }
  };
  setInterval(() => void look(), period * 1000);
  document.addEventListener('visibilitychange', () => void look());
}
