package semblante;

/** clients/runtime/semblante.h by JNI: semblante_jni.c. A frame is the array of {@link Frame#numbers}; a
 * handle is an address. Arrays must not be null: JNI ends the process for one. */
final class Native {
    static {
        System.loadLibrary("semblante_jni");
    }

    private Native() {}

    static native long headCreate(byte[] meshDrc, byte[] weights, byte[] rigJson, boolean jawTakesLip);
    static native void headDestroy(long head);
    static native int headVertexCount(long head);
    static native int[] headTriangles(long head);
    static native float[] headUvs(long head);
    static native byte[] headColors(long head);
    static native void headSetFrame(long head, float[] numbers);
    static native void headPositions(long head, float[] positions);
    static native void headNormals(long head, float[] positions, float[] normals);

    static native long streamCreate(boolean publish, boolean takeOver, double batch, boolean sound, long seed);
    static native void streamDestroy(long stream);
    static native void streamStart(long stream, double now);
    static native void streamStop(long stream, double now);
    static native void streamOpened(long stream, double now);
    static native void streamClosed(long stream, int code, double now);
    static native void streamTick(long stream, double now);
    static native double streamWakeTime(long stream);
    static native void streamReceive(long stream, byte[] message, double now);
    static native byte[] streamTakeBytes(long stream);
    static native boolean streamNextEvent(long stream, double[] numbers, String[] texts, Object[] said);
    static native void streamSetCaptions(long stream, boolean on);
    static native int streamFrameCount(long stream);
    static native double streamFrame(long stream, int index, float[] numbers);
    static native void streamPublish(long stream, double[] times, float[][] faces, double mediaTime, double now);
    static native void streamPublishSound(long stream, byte[] packet, double mediaTime);

    static native long playerCreate(double delay, boolean eased);
    static native void playerDestroy(long player);
    static native void playerFollow(long player, long stream);
    static native boolean playerAdvance(long player, double now, double elapsed);
    static native boolean playerShow(long player, long head);
    static native double playerTime(long player);

    static native long performanceCreate(byte[] json);
    static native void performanceDestroy(long performance);
    static native double performanceDuration(long performance);
    static native void performanceFrameAt(long performance, double ms, float[] numbers);

    static native long listenerCreate(int sampleRate);
    static native void listenerDestroy(long listener);
    static native boolean listenerPush(long listener, float[] samples, float[] numbers);


    static native void frameFromArkit(float[] coefficients, float[] numbers);
    static native void arkitFromFrame(float[] numbers, float[] coefficients);
    static native String arkitName(int shape);
}
