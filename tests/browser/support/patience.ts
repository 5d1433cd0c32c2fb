/** Timeout of a test's waits, ms: far longer than needed on a busy machine, so that only a fault reaches it. */
export const patience = 600_000;

/** What `work` gives, or an error with these words when it takes longer than `patience`. */
export async function within<T>(what: string, work: Promise<T>): Promise<T> {
  let timer: NodeJS.Timeout | undefined;
  const late = new Promise<never>((_, reject) => {
    timer = setTimeout(() => reject(new Error(`waited in vain: ${what}`)), patience);
  });
  try {
    return await Promise.race([work, late]);
  } finally {
    clearTimeout(timer);
  }
}

/** Polls a condition until it is true. */
export async function eventually(what: string, condition: () => Promise<boolean>, pause = 100): Promise<void> {
  const deadline = Date.now() + patience;
  while (!(await condition())) {
    if (Date.now() > deadline) throw new Error(`waited in vain: ${what}`);
    await new Promise((wake) => setTimeout(wake, pause));
  }
}
