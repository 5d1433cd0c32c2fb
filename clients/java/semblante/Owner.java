package semblante;

/** Owns a handle of the library until {@link #close}. One object is for one thread at a time. */
public abstract class Owner implements AutoCloseable {
    private long handle;

    Owner(long handle) {
        this.handle = handle;
    }

    final long handle() {
        if (handle == 0) throw new IllegalStateException("closed");
        return handle;
    }

    abstract void destroy(long handle);

    @Override
    public final void close() {
        if (handle != 0) destroy(handle);
        handle = 0;
    }
}
