package semblante;

/** Frames of a stream to the pose to show now. */
public final class Player extends Owner {
    /** `delay`: ms behind the stream's clock, 0: as short as the network allows. `eased`: smooth curves between frames. */
    public Player(double delay, boolean eased) {
        super(Native.playerCreate(delay, eased));
    }

    @Override
    void destroy(long handle) {
        Native.playerDestroy(handle);
    }

    /** The stream may be closed before the player. null: follows nobody. */
    public void follow(Stream stream) {
        Native.playerFollow(handle(), stream == null ? 0 : stream.handle());
    }

    /** To the display frame at `now`; `elapsed` ms since the one before. False: nothing to show yet. */
    public boolean advance(double now, double elapsed) {
        return Native.playerAdvance(handle(), now, elapsed);
    }

    /** Gives the head the pose to show. */
    public boolean show(Head head) {
        return Native.playerShow(handle(), head.handle());
    }

    /** Media time, ms; NaN before the first frame. */
    public double time() {
        return Native.playerTime(handle());
    }
}
