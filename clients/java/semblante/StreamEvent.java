package semblante;

/** What happened to a stream; see semblante_event of semblante.h. */
public final class StreamEvent {
    public enum Type { NONE, STATE, CONNECT, CLOSE, HEADER, KEYFRAME, FRAMES, CLOCK, REFUSED, FAULT, END, SOUND, TEXT }

    public enum State { CLOSED, CONNECTING, OPEN, WAITING }

    public final Type type;
    public final State state;
    public final int code;
    public final boolean isFinal;
    /** ms. */
    public final double mediaTime;
    public final String where;
    public final String message;
    /** Of TEXT, else null: a sentence that is said from `mediaTime` on. No letters: what is said stops. */
    public final String said;
    public final String language;
    /** Of TEXT: its number in the epoch, and ms. */
    public final long number;
    public final double duration;
    /** When the words of `said` begin, ms after `mediaTime`: those between spaces, tabs and ends of lines. */
    public final double[] wordTimes;

    StreamEvent(double[] numbers, String[] texts, Object[] words) {
        type = Type.values()[(int) numbers[0]];
        state = State.values()[(int) numbers[1]];
        code = (int) numbers[2];
        isFinal = numbers[3] != 0;
        mediaTime = numbers[4];
        where = texts[0];
        message = texts[1];
        boolean isText = type == Type.TEXT;
        said = isText ? (String) words[0] : null;
        language = isText ? (String) words[1] : null;
        wordTimes = isText ? (double[]) words[2] : null;
        number = isText ? (long) numbers[5] : 0;
        duration = isText ? numbers[6] : 0;
    }
}
