package semblante;

/** A frame at a time in ms. */
public final class TimedFrame {
    public final double time;
    public final Frame frame;

    public TimedFrame(double time, Frame frame) {
        this.time = time;
        this.frame = frame;
    }
}
