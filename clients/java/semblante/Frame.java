package semblante;

import java.util.Arrays;

/** One frame of face parameters, the complete state; a new one is the neutral face. */
public final class Frame {
    private static final int highLevel = 7;
    private static final int faps = 69;

    /** viseme1, viseme2, viseme_blend, expression1, intensity1, expression2, intensity2, then FAP 0 to 68 (0 to 2 unused). */
    final float[] numbers = new float[highLevel + faps];

    /** FAP `fap`, 3 to 68, in FAP units (rotations: 1e-5 rad). */
    public float fap(int fap) {
        return numbers[place(fap)];
    }

    public Frame setFap(int fap, float value) {
        numbers[place(fap)] = value;
        return this;
    }

    /** FAP 1: blend/63 of the first viseme, the rest of the second. Visemes 0 to 14. */
    public Frame setViseme(int first, int second, int blend) {
        numbers[0] = first;
        numbers[1] = second;
        numbers[2] = blend;
        return this;
    }

    /** FAP 2: two expressions, 0 to 6, with intensities of 63. */
    public Frame setExpression(int first, int intensity1, int second, int intensity2) {
        numbers[3] = first;
        numbers[4] = intensity1;
        numbers[5] = second;
        numbers[6] = intensity2;
        return this;
    }

    /** The first seven numbers: two visemes and their blend, two expressions with their intensities. */
    public int[] highLevel() {
        int[] values = new int[highLevel];
        for (int i = 0; i < highLevel; ++i) values[i] = (int) numbers[i];
        return values;
    }

    private static int place(int fap) {
        if (fap < 3 || fap >= faps) throw new IllegalArgumentException("FAPs are 3 to 68");
        return highLevel + fap;
    }

    @Override
    public boolean equals(Object other) {
        return other instanceof Frame && Arrays.equals(numbers, ((Frame) other).numbers);
    }

    @Override
    public int hashCode() {
        return Arrays.hashCode(numbers);
    }
}
