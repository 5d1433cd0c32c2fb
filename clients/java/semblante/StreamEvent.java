package semblante;

/** What happened to a stream; see semblante_event of semblante.h. */
public final class StreamEvent {
    public enum Type { NONE, STATE, CONNECT, CLOSE, HEADER, KEYFRAME, FRAMES, CLOCK, REFUSED, FAULT, END }

    public enum State { CLOSED, CONNECTING, OPEN, WAITING }

    public final Type type;
    public final State state;
    public final int code;
    public final boolean isFinal;
    /** ms. */
    public final double mediaTime;
    public final String where;
    public final String message;

    StreamEvent(double[] numbers, String[] texts) {
        type = Type.values()[(int) numbers[0]];
        state = State.values()[(int) numbers[1]];
        code = (int) numbers[2];
        isFinal = numbers[3] != 0;
        mediaTime = numbers[4];
        where = texts[0];
        message = texts[1];
    }
}
