package semblante;

import java.util.Objects;

/** Hears visemes in the sound of speech of any language, while it goes on; 52.5 ms behind it. */
public final class Listener extends Owner {
    /** 8000 to 192000 Hz. */
    public Listener(int sampleRate) {
        super(Native.listenerCreate(sampleRate));
    }

    @Override
    void destroy(long handle) {
        Native.listenerDestroy(handle);
    }

    /** Takes samples of one channel, of full scale 1. The mouth of the newest 10 ms that were heard; null: nothing new was. */
    public Frame push(float[] samples) {
        Frame frame = new Frame();
        return Native.listenerPush(handle(), Objects.requireNonNull(samples), frame.numbers) ? frame : null;
    }
}
