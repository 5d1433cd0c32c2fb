package semblante;

/** Faces of other systems. */
public final class Bridges {
    private Bridges() {}

    /** Of 52 coefficients, in the order of {@link #arkitName}. */
    public static Frame fromArkit(float[] coefficients) {
        if (coefficients.length != 52) throw new IllegalArgumentException("ARKit has 52 coefficients");
        Frame frame = new Frame();
        Native.frameFromArkit(coefficients, frame.numbers);
        return frame;
    }

    public static float[] toArkit(Frame frame) {
        float[] coefficients = new float[52];
        Native.arkitFromFrame(frame.numbers, coefficients);
        return coefficients;
    }

    /** The name of coefficient 0 to 51. */
    public static String arkitName(int shape) {
        return Native.arkitName(shape);
    }
}
