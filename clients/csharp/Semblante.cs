// Heads, streams, players and performances for C# (.NET, Mono, Unity): thin classes around Native.cs. One object is for one
// thread at a time. Times are ms of a steady clock of the caller's.
using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Semblante {

/// An error of the library. Code: the name of the result, such as "malformed"; Where: the member or byte at fault, may be empty.
public sealed class SemblanteException : Exception {
    public string Code { get; private set; }
    public string Where { get; private set; }

    internal SemblanteException(string code, string where, string message)
        : base(where.Length > 0 ? where + ": " + message : message) {
        Code = code;
        Where = where;
    }
}

/// Owns a handle of the library.
public abstract unsafe class Owner : IDisposable {
    internal IntPtr Handle;

    protected abstract void Destroy(IntPtr handle);

    public void Dispose() {
        Free();
        GC.SuppressFinalize(this);
    }

    ~Owner() { Free(); }

    void Free() {
        if (Handle != IntPtr.Zero) Destroy(Handle);
        Handle = IntPtr.Zero;
    }

    internal static string Text(byte* zeroTerminated, int most) {
        int length = 0;
        while (length < most && zeroTerminated[length] != 0) ++length;
        var bytes = new byte[length];
        Marshal.Copy((IntPtr)zeroTerminated, bytes, 0, length);
        return Encoding.UTF8.GetString(bytes);
    }

    internal static void Check(int result) {
        if (result == 0) return;
        string code = Marshal.PtrToStringAnsi(Native.semblante_result_name(result));
        throw new SemblanteException(code, "", code);
    }

    internal static void Check(int result, ref Native.Error error) {
        if (result == 0) return;
        fixed (Native.Error* at = &error) {
            throw new SemblanteException(Marshal.PtrToStringAnsi(Native.semblante_result_name(result)), Text(at->Where, 96),
                                         Text(at->Message, 256));
        }
    }
}

/// A face package and its current pose: frames in, vertices out.
public sealed unsafe class Head : Owner {
    public int VertexCount { get; private set; }
    readonly float[] positions;

    /// From the bytes of mesh.drc, weights and rig.json of one package.
    public Head(byte[] meshDrc, byte[] weights, byte[] rigJson, bool jawTakesLip = false) {
        fixed (byte* mesh = meshDrc, table = weights, rig = rigJson) {
            var package = new Native.Package {
                Size = (uint)sizeof(Native.Package), MeshDrc = mesh, MeshDrcSize = (UIntPtr)meshDrc.Length, Weights = table,
                WeightsSize = (UIntPtr)weights.Length, RigJson = rig, RigJsonSize = (UIntPtr)rigJson.Length
            };
            var options = new Native.HeadOptions { Size = (uint)sizeof(Native.HeadOptions), JawTakesLip = jawTakesLip ? 1u : 0u };
            Native.Error error;
            int result = Native.semblante_head_create(ref package, ref options, out Handle, out error);
            Check(result, ref error);
        }
        VertexCount = (int)Native.semblante_head_vertex_count(Handle);
        positions = new float[3 * VertexCount];
    }

    protected override void Destroy(IntPtr handle) { Native.semblante_head_destroy(handle); }

    /// 3 vertex numbers of each triangle.
    public int[] Triangles() {
        uint count;
        uint* corners = Native.semblante_head_triangles(Handle, out count);
        var triangles = new int[3 * count];
        for (int i = 0; i < triangles.Length; ++i) triangles[i] = (int)corners[i];
        return triangles;
    }

    /// 2 floats of each vertex, origin top left (Unity: use 1 - v); null if the mesh has none.
    public float[] Uvs() {
        float* uvs = Native.semblante_head_uvs(Handle);
        if (uvs == null) return null;
        var copy = new float[2 * VertexCount];
        Marshal.Copy((IntPtr)uvs, copy, 0, copy.Length);
        return copy;
    }

    /// 3 bytes of each vertex: red, green, blue, sRGB; they multiply material and image as linear light. Null, which is white, if
    /// the mesh has none.
    public byte[] Colors() {
        byte* colors = Native.semblante_head_colors(Handle);
        if (colors == null) return null;
        var copy = new byte[3 * VertexCount];
        Marshal.Copy((IntPtr)colors, copy, 0, copy.Length);
        return copy;
    }

    public void SetFrame(Frame frame) { Check(Native.semblante_head_set_frame(Handle, ref frame)); }

    /// The vertices of the current pose: 3 floats each, model units, right-handed (Unity: negate x and swap two corners of each
    /// triangle). The array is the head's own.
    public float[] Positions() {
        fixed (float* to = positions) Positions(to, positions.Length);
        return positions;
    }

    /// The same into memory of the caller's, such as a NativeArray: `capacity` in floats.
    public void Positions(float* to, int capacity) { Check(Native.semblante_head_positions(Handle, to, (UIntPtr)capacity)); }

    /// The unit normals of `Positions()`.
    public void Normals(float* positions, float* normals, int capacity) {
        Check(Native.semblante_head_normals(Handle, positions, normals, (UIntPtr)capacity));
    }
}

/// What happened to a stream; see semblante_event.
public struct StreamEvent {
    public EventType Type;
    public StreamState State;
    public uint Code;
    public bool IsFinal;
    public double MediaTime;
    public string Where, Message;

    // Of Text, else null: a sentence that is said from MediaTime on. No letters: what is said stops.
    public string Said, Language;
    public ulong Number;
    public double Duration;
    /// When the words of Said begin, ms after MediaTime: those between spaces, tabs and ends of lines.
    public double[] WordTimes;
}

/// One stream across connections. The caller owns the WebSocket (subprotocol "semblante.v1") and moves bytes.
public sealed unsafe class Stream : Owner {
    /// captions: Text events come beside the frames of speech.
    public Stream(bool publish = false, bool takeOver = false, double batch = 0, bool sound = false, bool captions = false) {
        var options = new Native.StreamOptions {
            Size = (uint)sizeof(Native.StreamOptions), Role = publish ? 1u : 0u, TakeOver = takeOver ? 1u : 0u, Batch = batch,
            Seed = (ulong)Guid.NewGuid().GetHashCode(), Sound = sound ? 1u : 0u,
            Captions = captions ? 1u : 0u
        };
        Native.Error error;
        int result = Native.semblante_stream_create(ref options, out Handle, out error);
        Check(result, ref error);
    }

    protected override void Destroy(IntPtr handle) { Native.semblante_stream_destroy(handle); }

    public void Start(double now) { Native.semblante_stream_start(Handle, now); }
    public void Stop(double now) { Native.semblante_stream_stop(Handle, now); }
    public void Opened(double now) { Native.semblante_stream_opened(Handle, now); }
    public void Closed(uint code, double now) { Native.semblante_stream_closed(Handle, code, now); }
    public void Tick(double now) { Native.semblante_stream_tick(Handle, now); }
    public double WakeTime { get { return Native.semblante_stream_wake_time(Handle); } }

    public void Receive(byte[] message, double now) {
        fixed (byte* bytes = message) Check(Native.semblante_stream_receive(Handle, bytes, (UIntPtr)message.Length, now));
    }

    /// The next binary message to send; null: none.
    public byte[] TakeBytes() {
        UIntPtr size;
        byte* bytes = Native.semblante_stream_take_bytes(Handle, out size);
        if (bytes == null) return null;
        var copy = new byte[(int)size];
        Marshal.Copy((IntPtr)bytes, copy, 0, copy.Length);
        return copy;
    }

    public bool NextEvent(out StreamEvent happened) {
        var taken = new Native.Event { Size = (uint)sizeof(Native.Event) };
        bool any = Native.semblante_stream_next_event(Handle, ref taken) != 0;
        happened = new StreamEvent {
            Type = (EventType)taken.Type, State = (StreamState)taken.State, Code = taken.Code, IsFinal = taken.IsFinal != 0,
            MediaTime = taken.MediaTime, Where = Text(taken.Error.Where, 96), Message = Text(taken.Error.Message, 256)
        };
        if (any && happened.Type == EventType.Text) {
            happened.Said = Text(taken.Text, 2000);
            happened.Language = Text(taken.Language, 64);
            happened.Number = taken.Sequence;
            happened.Duration = taken.Duration;
            uint words = 0;
            Check(Native.semblante_score_words(taken.Packet, taken.PacketSize, null, ref words));
            happened.WordTimes = new double[words];
            Check(Native.semblante_score_words(taken.Packet, taken.PacketSize, happened.WordTimes, ref words));
        }
        return any;
    }

    /// Whether Text events come beside the frames of speech; also after a new connection.
    public void SetCaptions(bool on) { Check(Native.semblante_stream_set_captions(Handle, on ? 1u : 0u)); }

    /// The frames of the newest Keyframe or Frames event.
    public TimedFrame[] Frames() {
        uint count;
        TimedFrame* first = Native.semblante_stream_frames(Handle, out count);
        var frames = new TimedFrame[count];
        for (uint i = 0; i < count; ++i) frames[i] = first[i];
        return frames;
    }

    public void Publish(TimedFrame[] frames, double mediaTime, double now) {
        fixed (TimedFrame* first = frames) {
            Check(Native.semblante_stream_publish(Handle, first, (uint)frames.Length, mediaTime, now));
        }
    }

    /// One Opus packet, heard from mediaTime on, on the clock of the frames; of a publisher with sound.
    public void PublishSound(byte[] packet, double mediaTime) {
        Check(Native.semblante_stream_publish_sound(Handle, packet, (uint)packet.Length, mediaTime));
    }
}

/// Frames of a stream to the pose to show now.
public sealed unsafe class Player : Owner {
    Stream followed;

    public Player(double delay = 0, bool eased = false) {
        var options = new Native.PlayerOptions { Size = (uint)sizeof(Native.PlayerOptions), Delay = delay, Eased = eased ? 1u : 0u };
        Native.Error error;
        int result = Native.semblante_player_create(ref options, out Handle, out error);
        Check(result, ref error);
    }

    protected override void Destroy(IntPtr handle) { Native.semblante_player_destroy(handle); }

    /// The stream that is followed, which the player keeps alive; null: nobody.
    public Stream Followed { get { return followed; } }

    /// null: follows nobody.
    public void Follow(Stream stream) {
        Check(Native.semblante_player_follow(Handle, stream == null ? IntPtr.Zero : stream.Handle));
        followed = stream;
    }

    public void Push(TimedFrame[] frames, double now) {
        fixed (TimedFrame* first = frames) Check(Native.semblante_player_push(Handle, first, (uint)frames.Length, now));
    }

    /// To the display frame at `now`; `elapsed` since the one before (Unity: 1000 * Time.deltaTime).
    public bool Advance(double now, double elapsed) { return Native.semblante_player_advance(Handle, now, elapsed) != 0; }
    public bool MoveTo(double mediaTime) { return Native.semblante_player_move_to(Handle, mediaTime) != 0; }
    public bool Show(Head head) { return Native.semblante_player_show(Handle, head.Handle) != 0; }
    /// Media time, ms; NaN before the first frame.
    public double Time { get { return Native.semblante_player_time(Handle); } }
}

/// A performance document: the face at any time.
public sealed unsafe class Performance : Owner {
    public Performance(byte[] json) {
        fixed (byte* text = json) {
            Native.Error error;
            int result = Native.semblante_performance_create(text, (UIntPtr)json.Length, out Handle, out error);
            Check(result, ref error);
        }
    }

    protected override void Destroy(IntPtr handle) { Native.semblante_performance_destroy(handle); }

    /// ms; 0: endless.
    public double Duration { get { return Native.semblante_performance_duration(Handle); } }

    public Frame FrameAt(double ms) {
        Frame frame;
        Check(Native.semblante_performance_frame_at(Handle, ms, ms, out frame));
        return frame;
    }
}

/// Hears visemes in the sound of speech of any language, while it goes on; 52.5 ms behind it.
public sealed unsafe class Listener : Owner {
    /// sampleRate: 8000 to 192000 Hz.
    public Listener(int sampleRate) {
        var options = new Native.ListenerOptions { Size = (uint)sizeof(Native.ListenerOptions), SampleRate = (uint)sampleRate };
        Native.Error error;
        int result = Native.semblante_listener_create(ref options, out Handle, out error);
        Check(result, ref error);
    }

    protected override void Destroy(IntPtr handle) { Native.semblante_listener_destroy(handle); }

    /// Takes samples of one channel, of full scale 1. The mouth of the newest 10 ms that were heard; false: nothing new was.
    public bool Push(float[] samples, out Frame frame) {
        const int nothingNew = 9;
        frame = new Frame();
        var found = false;
        fixed (float* first = samples) {
            for (uint at = 0, taken = 0; ; at += taken) {
                var heard = new Native.Heard { Size = (uint)sizeof(Native.Heard) };
                int result = Native.semblante_listener_push(Handle, first + at, (uint)samples.Length - at, out taken, ref heard);
                if (result == nothingNew) return found;
                Check(result);
                Native.Error error;
                result = Native.semblante_frame_from_oculus(heard.Weights, out frame, out error);
                Check(result, ref error);
                found = true;
            }
        }
    }
}

/// Faces of other systems.
public static unsafe class Bridges {
    public static Frame FromArkit(float[] coefficients) {
        if (coefficients.Length != 52) throw new ArgumentException("ARKit has 52 coefficients");
        Frame frame;
        Native.Error error;
        fixed (float* values = coefficients) {
            int result = Native.semblante_frame_from_arkit(values, out frame, out error);
            Owner.Check(result, ref error);
        }
        return frame;
    }

    public static float[] ToArkit(Frame frame) {
        var coefficients = new float[52];
        fixed (float* values = coefficients) Owner.Check(Native.semblante_arkit_from_frame(ref frame, values));
        return coefficients;
    }

    public static string ArkitName(int shape) { return Marshal.PtrToStringAnsi(Native.semblante_arkit_name((uint)shape)); }
}

}
