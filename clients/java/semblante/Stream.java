package semblante;

import java.util.List;
import java.util.Objects;
import java.util.Random;

/**
 * One stream across connections. The caller owns the WebSocket (subprotocol "semblante.v1") and moves bytes. Times are ms of
 * a steady clock of the caller's.
 */
public final class Stream extends Owner {
    private final double[] numbers = new double[7];
    private final String[] texts = new String[2];
    private final Object[] said = new Object[3];

    /** A subscriber. */
    public Stream() {
        this(false, false, 0);
    }

    /** `batch`: a publisher's frames of so many ms travel in one message. */
    public Stream(boolean publish, boolean takeOver, double batch) {
        this(publish, takeOver, batch, false);
    }

    /** `sound`: this publisher sends sound too, by publishSound(). A subscriber has no events of sound here. */
    public Stream(boolean publish, boolean takeOver, double batch, boolean sound) {
        super(Native.streamCreate(publish, takeOver, batch, publish && sound, new Random().nextLong()));
    }

    @Override
    void destroy(long handle) {
        Native.streamDestroy(handle);
    }

    public void start(double now) {
        Native.streamStart(handle(), now);
    }

    public void stop(double now) {
        Native.streamStop(handle(), now);
    }

    public void opened(double now) {
        Native.streamOpened(handle(), now);
    }

    public void closed(int code, double now) {
        Native.streamClosed(handle(), code, now);
    }

    public void tick(double now) {
        Native.streamTick(handle(), now);
    }

    /** When tick() has something to do. */
    public double wakeTime() {
        return Native.streamWakeTime(handle());
    }

    public void receive(byte[] message, double now) {
        Native.streamReceive(handle(), Objects.requireNonNull(message), now);
    }

    /** The next binary message to send; null: none. */
    public byte[] takeBytes() {
        return Native.streamTakeBytes(handle());
    }

    /** null: none. */
    public StreamEvent nextEvent() {
        return Native.streamNextEvent(handle(), numbers, texts, said) ? new StreamEvent(numbers, texts, said) : null;
    }

    /** Whether TEXT events come beside the frames of speech; also after a new connection. */
    public void setCaptions(boolean on) {
        Native.streamSetCaptions(handle(), on);
    }

    /** The frames of the newest KEYFRAME or FRAMES event. */
    public TimedFrame[] frames() {
        TimedFrame[] frames = new TimedFrame[Native.streamFrameCount(handle())];
        for (int i = 0; i < frames.length; ++i) {
            Frame frame = new Frame();
            frames[i] = new TimedFrame(Native.streamFrame(handle(), i, frame.numbers), frame);
        }
        return frames;
    }

    public void publish(List<TimedFrame> frames, double mediaTime, double now) {
        double[] times = new double[frames.size()];
        float[][] faces = new float[frames.size()][];
        for (int i = 0; i < times.length; ++i) {
            times[i] = frames.get(i).time;
            faces[i] = frames.get(i).frame.numbers;
        }
        Native.streamPublish(handle(), times, faces, mediaTime, now);
    }

    /** One Opus packet, heard from `mediaTime` on, on the clock of the frames; of a publisher with sound. */
    public void publishSound(byte[] packet, double mediaTime) {
        Native.streamPublishSound(handle(), Objects.requireNonNull(packet), mediaTime);
    }
}
