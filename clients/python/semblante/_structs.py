# Generated from clients/runtime/semblante.h and core/kernel/semblante_kernel.h by semblante-codegen-declarations; change the
# headers, not this.
"""The structs of semblante.h: the same members in the same order."""

import ctypes
from ctypes import POINTER, c_char, c_char_p, c_double, c_float, c_size_t, c_uint8, c_uint32, c_uint64
from typing import Any


class Sized(ctypes.Structure):
    """A struct that begins with its own size."""

    def __init__(self, **members: Any) -> None:
        super().__init__(size=ctypes.sizeof(type(self)), **members)


class Frame(ctypes.Structure):
    """One frame of face parameters: the complete state. All zero is the neutral face. 284 bytes."""

    _fields_ = [
        ("viseme1", c_uint8),
        ("viseme2", c_uint8),
        ("viseme_blend", c_uint8),
        ("expression1", c_uint8),
        ("intensity1", c_uint8),
        ("expression2", c_uint8),
        ("intensity2", c_uint8),
        ("reserved", c_uint8),
        ("fap", c_float * 69),
    ]


class Iris(ctypes.Structure):
    """The iris of one eye on the neutral face. 24 bytes."""

    _fields_ = [
        ("axis", c_float * 3),
        ("pupil_radius", c_float),
        ("iris_radius", c_float),
        ("bend", c_float),
    ]


class Tongue(ctypes.Structure):
    """The tongue on the neutral face. 44 bytes."""

    _fields_ = [
        ("origin", c_float * 3),
        ("left", c_float * 3),
        ("up", c_float * 3),
        ("half_width", c_float),
        ("roll_limit", c_float),
    ]


class Lids(ctypes.Structure):
    """The lids of one eye on the neutral face. They slide round the eye's axis: the line through its pivot along x. 100
    bytes."""

    _fields_ = [
        ("gaze", c_float * 3),
        ("slit", c_float),
        ("opening", c_float),
        ("gaze_share", c_float * 2),
        ("ball", c_float * 17),
        ("lift", c_float),
    ]


class Companion(ctypes.Structure):
    """A feature point that follows another one: `share` of the displacement of `leader`, with what the leader itself
    follows by an entry that is no choice (one step: that leader's own leader counts without what it follows). 8
    bytes."""

    _fields_ = [
        ("point", c_uint8),
        ("leader", c_uint8),
        ("is_choice", c_uint8),
        ("reserved", c_uint8),
        ("share", c_float),
    ]


class Rig(ctypes.Structure):
    """The data of one model for evaluating frames. The caller owns the arrays, which must outlive the calls."""

    _fields_ = [
        ("viseme", POINTER(c_float)),
        ("expression", POINTER(c_float)),
        ("fapu", c_float * 5),
        ("eye_pivot", c_float * 3 * 2),
        ("head_pivot", c_float * 3),
        ("viseme_share", c_float),
        ("iris", Iris * 2),
        ("tongue", Tongue),
        ("companion", POINTER(Companion)),
        ("companion_count", c_uint32),
        ("lip_share", c_float),
        ("lids", Lids * 2),
    ]


class Pose(ctypes.Structure):
    """A pose: displacements of the FPs and motions of the rigid parts. Poses can be interpolated linearly. All members
    are floats. The pivots, `iris`, `tongue` and `lids` are copied from the rig."""

    _fields_ = [
        ("fp", c_float * 252),
        ("eye_rotation", c_float * 4 * 2),
        ("eye_translation", c_float * 3 * 2),
        ("head_rotation", c_float * 4),
        ("eye_pivot", c_float * 3 * 2),
        ("head_pivot", c_float * 3),
        ("pupil_growth", c_float * 2),
        ("tongue_roll", c_float),
        ("iris", Iris * 2),
        ("tongue", Tongue),
        ("lid_closure", c_float * 2 * 2),
        ("lids", Lids * 2),
    ]


class Face(ctypes.Structure):
    """A mesh with its influence table, one row per vertex: entries row_offsets[v] .. row_offsets[v + 1] - 1. Not
    validated: the reader of a table must check that offsets do not decrease, points are < 84 and rigid is one of the
    values above."""

    _fields_ = [
        ("vertex_count", c_uint32),
        ("rest", POINTER(c_float)),
        ("row_offsets", POINTER(c_uint32)),
        ("row_points", POINTER(c_uint8)),
        ("row_weights", POINTER(c_float)),
        ("rigid", POINTER(c_uint8)),
        ("turn", POINTER(c_uint8)),
    ]


class Triangles(ctypes.Structure):
    """The triangles of a face. Not validated: corners must be < vertex_count, joined[v] <= v."""

    _fields_ = [
        ("vertex_count", c_uint32),
        ("triangle_count", c_uint32),
        ("corners", POINTER(c_uint32)),
        ("joined", POINTER(c_uint32)),
    ]


class Error(ctypes.Structure):
    """Text for display, zero-terminated UTF-8, truncated to fit. `where` names the member or byte at fault; may be
    empty. Functions that take one accept null. They write it only when they fail."""

    _fields_ = [
        ("where", c_char * 96),
        ("message", c_char * 256),
    ]


class Package(Sized):
    """The parts of a face package. Read during the call only; everything needed is copied."""

    _fields_ = [
        ("size", c_uint32),
        ("vertex_count", c_uint32),
        ("positions", POINTER(c_float)),
        ("mesh_sha256", POINTER(c_uint8)),
        ("triangles", POINTER(c_uint32)),
        ("normals", POINTER(c_float)),
        ("triangle_count", c_uint32),
        ("reserved", c_uint32),
        ("mesh_drc", POINTER(c_uint8)),
        ("mesh_drc_size", c_size_t),
        ("weights", POINTER(c_uint8)),
        ("weights_size", c_size_t),
        ("rig_json", c_char_p),
        ("rig_json_size", c_size_t),
    ]


class HeadOptions(Sized):
    _fields_ = [
        ("size", c_uint32),
        ("flags", c_uint32),
        ("viseme_share", c_float),
        ("jaw_takes_lip", c_uint32),
    ]


class TimedFrame(ctypes.Structure):
    """A frame at a time. 296 bytes."""

    _fields_ = [
        ("time", c_double),
        ("frame", Frame),
    ]


class StreamOptions(Sized):
    _fields_ = [
        ("size", c_uint32),
        ("role", c_uint32),
        ("take_over", c_uint32),
        ("max_message_bytes", c_uint32),
        ("retry_first", c_double),
        ("retry_longest", c_double),
        ("seed", c_uint64),
        ("ping_interval", c_double),
        ("silence_limit", c_double),
        ("batch", c_double),
        ("resume_epoch", c_uint64),
        ("resume_sequence", c_uint64),
        ("sound", c_uint32),
        ("text", c_uint32),
        ("captions", c_uint32),
        ("reserved", c_uint32),
    ]


class Event(Sized):
    """Members that the type of the event does not name are zero."""

    _fields_ = [
        ("size", c_uint32),
        ("type", c_uint32),
        ("state", c_uint32),
        ("code", c_uint32),
        ("resumed", c_uint32),
        ("is_final", c_uint32),
        ("epoch", c_uint64),
        ("sequence", c_uint64),
        ("media_time", c_double),
        ("round_trip", c_double),
        ("server_offset", c_double),
        ("error", Error),
        ("duration", c_double),
        ("packet", POINTER(c_uint8)),
        ("packet_size", c_uint32),
        ("reserved", c_uint32),
        ("text", c_char_p),
        ("language", c_char_p),
    ]


class Header(Sized):
    """The newest header. Texts are zero-terminated UTF-8, valid until the next header."""

    _fields_ = [
        ("size", c_uint32),
        ("resumed", c_uint32),
        ("epoch", c_uint64),
        ("sequence", c_uint64),
        ("media_time", c_double),
        ("server_time", c_double),
        ("frame_rate", c_double),
        ("batch_interval", c_double),
        ("viseme_share", c_double),
        ("stream", c_char_p),
        ("title", c_char_p),
        ("model", c_char_p),
        ("quantizer", POINTER(c_double)),
        ("sound_codec", c_uint32),
        ("sound_rate", c_uint32),
        ("sound_channels", c_uint32),
        ("sound_bitrate", c_uint32),
    ]


class Clock(Sized):
    """What is known of the stream's clock."""

    _fields_ = [
        ("size", c_uint32),
        ("steps", c_uint32),
        ("media_time", c_double),
        ("uncertainty", c_double),
        ("drift", c_double),
        ("round_trip", c_double),
        ("server_offset", c_double),
    ]


class PlayerOptions(Sized):
    _fields_ = [
        ("size", c_uint32),
        ("eased", c_uint32),
        ("delay", c_double),
        ("max_frames", c_uint32),
        ("reserved", c_uint32),
    ]


class PlayerStatistics(Sized):
    _fields_ = [
        ("size", c_uint32),
        ("held", c_uint32),
        ("delay", c_double),
        ("wanted_delay", c_double),
        ("jitter", c_double),
        ("error", c_double),
        ("starved_time", c_double),
        ("starved", c_uint64),
        ("snaps", c_uint64),
    ]


class Moment(Sized):
    """The current moment with everything that decides the pose, for callers who evaluate frames themselves."""

    _fields_ = [
        ("size", c_uint32),
        ("is_curve", c_uint32),
        ("from_time", c_double),
        ("to_time", c_double),
        ("viseme_share", c_double),
        ("t", c_float),
        ("spans", c_float * 3),
        ("frames", Frame * 4),
    ]


class TakeOptions(Sized):
    """How a .fap file is understood; without meaning for other formats."""

    _fields_ = [
        ("size", c_uint32),
        ("absent", c_uint32),
        ("gaps", c_uint32),
    ]


class TakeWarning(Sized):
    """A deviation from the format that was accepted."""

    _fields_ = [
        ("size", c_uint32),
        ("oddity", c_uint32),
        ("line", c_uint32),
        ("count", c_uint32),
        ("message", c_char * 256),
    ]


class ListenerOptions(Sized):
    _fields_ = [
        ("size", c_uint32),
        ("sample_rate", c_uint32),
    ]


class Heard(Sized):
    """What is heard in 10 ms. Visemes are those of FAP 1, and of Oculus, in their order: semblante_frame_from_oculus
    makes a frame of the weights."""

    _fields_ = [
        ("size", c_uint32),
        ("level", c_float),
        ("time", c_double),
        ("weights", c_float * 15),
        ("probability", c_float * 15),
    ]


structs = {
    "semblante_frame": Frame,
    "semblante_iris": Iris,
    "semblante_tongue": Tongue,
    "semblante_lids": Lids,
    "semblante_companion": Companion,
    "semblante_rig": Rig,
    "semblante_pose": Pose,
    "semblante_face": Face,
    "semblante_triangles": Triangles,
    "semblante_error": Error,
    "semblante_package": Package,
    "semblante_head_options": HeadOptions,
    "semblante_timed_frame": TimedFrame,
    "semblante_stream_options": StreamOptions,
    "semblante_event": Event,
    "semblante_header": Header,
    "semblante_clock": Clock,
    "semblante_player_options": PlayerOptions,
    "semblante_player_statistics": PlayerStatistics,
    "semblante_moment": Moment,
    "semblante_take_options": TakeOptions,
    "semblante_take_warning": TakeWarning,
    "semblante_listener_options": ListenerOptions,
    "semblante_heard": Heard,
}
