package semblante;

import java.util.Objects;

/** A face package and its current pose: frames in, vertices out. */
public final class Head extends Owner {
    public final int vertexCount;

    /** From the bytes of mesh.drc, weights and rig.json of one package. */
    public Head(byte[] meshDrc, byte[] weights, byte[] rigJson) {
        this(meshDrc, weights, rigJson, false);
    }

    /** {@code jawTakesLip}: FAP 3 alone takes the lower lip along, as on a human face; in the standard it does not. */
    public Head(byte[] meshDrc, byte[] weights, byte[] rigJson, boolean jawTakesLip) {
        super(Native.headCreate(Objects.requireNonNull(meshDrc), Objects.requireNonNull(weights), Objects.requireNonNull(rigJson),
                jawTakesLip));
        vertexCount = Native.headVertexCount(handle());
    }

    @Override
    void destroy(long handle) {
        Native.headDestroy(handle);
    }

    /** 3 vertex numbers of each triangle. */
    public int[] triangles() {
        return Native.headTriangles(handle());
    }

    /** 2 floats of each vertex, origin top left; null if the mesh has none. */
    public float[] uvs() {
        return Native.headUvs(handle());
    }

    /**
     * 3 bytes of each vertex: red, green, blue, sRGB, 0..255 by {@code & 0xff}; they multiply material and image as linear
     * light. Null, which is white, if the mesh has none.
     */
    public byte[] colors() {
        return Native.headColors(handle());
    }

    public void setFrame(Frame frame) {
        Native.headSetFrame(handle(), frame.numbers);
    }

    /** Writes the vertices of the current pose: 3 floats each, model units, right-handed. */
    public void positions(float[] to) {
        Native.headPositions(handle(), Objects.requireNonNull(to));
    }

    /** Writes the unit normals of `positions`. */
    public void normals(float[] positions, float[] to) {
        Native.headNormals(handle(), Objects.requireNonNull(positions), Objects.requireNonNull(to));
    }
}
