// The declarations of clients/runtime/semblante.h for C#: structs with the same members in the same order, functions with their
// types. tests/unit/csharp compares their sizes with a C compiler's. No other file of this folder uses P/Invoke.
using System;
using System.Runtime.InteropServices;

namespace Semblante {

/// One frame of face parameters, the complete state; all zero is the neutral face. 284 bytes.
[StructLayout(LayoutKind.Sequential)]
public unsafe struct Frame {
    public byte Viseme1, Viseme2, VisemeBlend;                          // FAP 1: blend/63 of the first, the rest of the second
    public byte Expression1, Intensity1, Expression2, Intensity2;       // FAP 2: intensities of 63
    byte reserved;
    public fixed float Fap[69];                                         // FAP n at n, in FAP units (rotations: 1e-5 rad)
}

/// A frame at a time in ms. 296 bytes.
[StructLayout(LayoutKind.Sequential)]
public struct TimedFrame {
    public double Time;
    public Frame Frame;
}

public enum EventType : uint { None, State, Connect, Close, Header, Keyframe, Frames, Clock, Refused, Fault, End, Sound, Text }

public enum StreamState : uint { Closed, Connecting, Open, Waiting }

static unsafe class Native {
    // Unity on iOS links statically: "__Internal".
#if UNITY_IOS && !UNITY_EDITOR
    const string Library = "__Internal";
#else
    const string Library = "semblante";
#endif

    [StructLayout(LayoutKind.Sequential)]
    public struct Error {
        public fixed byte Where[96];
        public fixed byte Message[256];
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Package {
        public uint Size, VertexCount;
        public float* Positions;
        public byte* MeshSha256;
        public uint* Triangles;
        public float* Normals;
        public uint TriangleCount, Reserved;
        public byte* MeshDrc;
        public UIntPtr MeshDrcSize;
        public byte* Weights;
        public UIntPtr WeightsSize;
        public byte* RigJson;
        public UIntPtr RigJsonSize;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct HeadOptions {
        public uint Size, Flags;
        public float VisemeShare;
        public uint JawTakesLip;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct StreamOptions {
        public uint Size, Role, TakeOver, MaxMessageBytes;
        public double RetryFirst, RetryLongest;
        public ulong Seed;
        public double PingInterval, SilenceLimit, Batch;
        public ulong ResumeEpoch, ResumeSequence;
        public uint Sound, Text, Captions, Reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Event {
        public uint Size, Type, State, Code, Resumed, IsFinal;
        public ulong Epoch, Sequence;
        public double MediaTime, RoundTrip, ServerOffset;
        public Error Error;
        public double Duration;
        public byte* Packet;
        public uint PacketSize, Reserved;
        public byte* Text;
        public byte* Language;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct PlayerOptions {
        public uint Size, Eased;
        public double Delay;
        public uint MaxFrames, Reserved;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct ListenerOptions {
        public uint Size, SampleRate;
    }

    [StructLayout(LayoutKind.Sequential)]
    public struct Heard {
        public uint Size;
        public float Level;
        public double Time;
        public fixed float Weights[15];
        public fixed float Probability[15];
    }

    [DllImport(Library)] public static extern uint semblante_sdk_version();
    [DllImport(Library)] public static extern IntPtr semblante_result_name(int result);

    [DllImport(Library)] public static extern int semblante_head_create(ref Package package, ref HeadOptions options, out IntPtr head, out Error error);
    [DllImport(Library)] public static extern void semblante_head_destroy(IntPtr head);
    [DllImport(Library)] public static extern uint semblante_head_vertex_count(IntPtr head);
    [DllImport(Library)] public static extern uint* semblante_head_triangles(IntPtr head, out uint count);
    [DllImport(Library)] public static extern float* semblante_head_uvs(IntPtr head);
    [DllImport(Library)] public static extern byte* semblante_head_colors(IntPtr head);
    [DllImport(Library)] public static extern int semblante_head_set_frame(IntPtr head, ref Frame frame);
    [DllImport(Library)] public static extern int semblante_head_positions(IntPtr head, float* positions, UIntPtr capacity);
    [DllImport(Library)] public static extern int semblante_head_normals(IntPtr head, float* positions, float* normals, UIntPtr capacity);

    [DllImport(Library)] public static extern int semblante_frame_from_arkit(float* coefficients, out Frame frame, out Error error);
    [DllImport(Library)] public static extern int semblante_arkit_from_frame(ref Frame frame, float* coefficients);
    [DllImport(Library)] public static extern IntPtr semblante_arkit_name(uint shape);

    [DllImport(Library)] public static extern int semblante_stream_create(ref StreamOptions options, out IntPtr stream, out Error error);
    [DllImport(Library)] public static extern void semblante_stream_destroy(IntPtr stream);
    [DllImport(Library)] public static extern void semblante_stream_start(IntPtr stream, double now);
    [DllImport(Library)] public static extern void semblante_stream_stop(IntPtr stream, double now);
    [DllImport(Library)] public static extern void semblante_stream_opened(IntPtr stream, double now);
    [DllImport(Library)] public static extern int semblante_stream_receive(IntPtr stream, byte* bytes, UIntPtr size, double now);
    [DllImport(Library)] public static extern void semblante_stream_closed(IntPtr stream, uint code, double now);
    [DllImport(Library)] public static extern void semblante_stream_tick(IntPtr stream, double now);
    [DllImport(Library)] public static extern double semblante_stream_wake_time(IntPtr stream);
    [DllImport(Library)] public static extern byte* semblante_stream_take_bytes(IntPtr stream, out UIntPtr size);
    [DllImport(Library)] public static extern uint semblante_stream_next_event(IntPtr stream, ref Event taken);
    [DllImport(Library)] public static extern TimedFrame* semblante_stream_frames(IntPtr stream, out uint count);
    [DllImport(Library)] public static extern int semblante_stream_publish(IntPtr stream, TimedFrame* frames, uint count, double mediaTime, double now);
    [DllImport(Library)] public static extern int semblante_stream_set_captions(IntPtr stream, uint on);
    [DllImport(Library)] public static extern int semblante_score_words(byte* score, uint size, double[] times, ref uint count);
    [DllImport(Library)] public static extern int semblante_stream_publish_sound(IntPtr stream, byte[] packet, uint size, double mediaTime);

    [DllImport(Library)] public static extern int semblante_player_create(ref PlayerOptions options, out IntPtr player, out Error error);
    [DllImport(Library)] public static extern void semblante_player_destroy(IntPtr player);
    [DllImport(Library)] public static extern int semblante_player_follow(IntPtr player, IntPtr stream);
    [DllImport(Library)] public static extern int semblante_player_push(IntPtr player, TimedFrame* frames, uint count, double now);
    [DllImport(Library)] public static extern uint semblante_player_advance(IntPtr player, double now, double elapsed);
    [DllImport(Library)] public static extern uint semblante_player_move_to(IntPtr player, double mediaTime);
    [DllImport(Library)] public static extern uint semblante_player_show(IntPtr player, IntPtr head);
    [DllImport(Library)] public static extern double semblante_player_time(IntPtr player);

    [DllImport(Library)] public static extern int semblante_performance_create(byte* json, UIntPtr size, out IntPtr performance, out Error error);
    [DllImport(Library)] public static extern void semblante_performance_destroy(IntPtr performance);
    [DllImport(Library)] public static extern double semblante_performance_duration(IntPtr performance);
    [DllImport(Library)] public static extern int semblante_performance_frame_at(IntPtr performance, double ms, double idleMs, out Frame frame);

    [DllImport(Library)] public static extern int semblante_frame_from_oculus(float* weights, out Frame frame, out Error error);
    [DllImport(Library)] public static extern int semblante_listener_create(ref ListenerOptions options, out IntPtr listener, out Error error);
    [DllImport(Library)] public static extern void semblante_listener_destroy(IntPtr listener);
    [DllImport(Library)] public static extern int semblante_listener_push(IntPtr listener, float* samples, uint count, out uint taken, ref Heard heard);
}

}
