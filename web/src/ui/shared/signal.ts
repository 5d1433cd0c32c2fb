/** An observable value. */
export class Signal<T> {
  private readonly listeners = new Set<(value: T) => void>();

  constructor(private current: T) {}

  get value(): T {
    return this.current;
  }

  set(value: T): void {
    if (Object.is(value, this.current)) return;
    this.current = value;
    this.notify();
  }

  /** Calls the listeners, for a value that was changed in place. */
  notify(): void {
    for (const listener of [...this.listeners]) listener(this.current);
  }

  /** Calls the listener immediately and on every change. Returns the function that removes it. */
  watch(listener: (value: T) => void): () => void {
    this.listeners.add(listener);
    listener(this.current);
    return () => this.listeners.delete(listener);
  }
}
