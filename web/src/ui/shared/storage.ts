/** A storage of the page, or null where it is forbidden: reading the global throws there. */
function allowed(read: () => Storage): Storage | null {
  try {
    return read();
  } catch {
    return null;
  }
}

/** Kept until it is cleared, for all tabs. */
export const browserStorage = (): Storage | null => allowed(() => localStorage);

/** Kept as long as this tab. */
export const tabStorage = (): Storage | null => allowed(() => sessionStorage);
