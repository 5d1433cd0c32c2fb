/** ms that a test waits for what must happen: far longer than it takes on the busiest machine, so only a fault meets it. */
export const patience = 600_000;

/** Asks again and again until the answer is yes. */
export async function eventually(what: string, condition: () => Promise<boolean>, pause = 100): Promise<void> {
  const deadline = Date.now() + patience;
  while (!(await condition())) {
    if (Date.now() > deadline) throw new Error(`waited in vain: ${what}`);
    await new Promise((wake) => setTimeout(wake, pause));
  }
}
