package semblante;

import java.util.Objects;

/** A performance document: the face at any time. */
public final class Performance extends Owner {
    /** Of UTF-8 text. */
    public Performance(byte[] json) {
        super(Native.performanceCreate(Objects.requireNonNull(json)));
    }

    @Override
    void destroy(long handle) {
        Native.performanceDestroy(handle);
    }

    /** ms; 0: endless. */
    public double duration() {
        return Native.performanceDuration(handle());
    }

    public Frame frameAt(double ms) {
        Frame frame = new Frame();
        Native.performanceFrameAt(handle(), ms, frame.numbers);
        return frame;
    }
}
