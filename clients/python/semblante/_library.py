"""The shared library of the runtime and the declarations of clients/runtime/semblante.h: structs with the same members in
the same order, functions with their types. tests/unit/python compares both with the header as a C compiler reads it.
"""

import ctypes
import ctypes.util
import os
import pathlib
from ctypes import POINTER, c_char, c_char_p, c_double, c_float, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p

FP_COUNT = 84
VISEME_COUNT = 15
FAP_COUNT = 68
VERSION = 0x000200  # SEMBLANTE_SDK_VERSION that the declarations were written for


def _find():
    """The library named by SEMBLANTE_LIBRARY, else the one inside this package, else the one of the system."""
    named = os.environ.get("SEMBLANTE_LIBRARY")
    if named:
        return named
    bundled = pathlib.Path(__file__).with_name("libsemblante.so")
    if bundled.exists():
        return str(bundled)
    found = ctypes.util.find_library("semblante")
    if found:
        return found
    raise ImportError("libsemblante.so was not found: install it, or name it by the environment variable SEMBLANTE_LIBRARY")


class Error(ctypes.Structure):
    _fields_ = [("where", c_char * 96), ("message", c_char * 256)]


class Frame(ctypes.Structure):
    """One frame of face parameters, the complete state; all zero is the neutral face. `fap[n]` is FAP n in FAP units
    (rotations: 1e-5 rad); FAPs 1 and 2 are the members before it. 284 bytes."""

    _fields_ = [("viseme1", c_uint8), ("viseme2", c_uint8), ("viseme_blend", c_uint8), ("expression1", c_uint8),
                ("intensity1", c_uint8), ("expression2", c_uint8), ("intensity2", c_uint8), ("reserved", c_uint8),
                ("fap", c_float * (FAP_COUNT + 1))]

    def __repr__(self):
        faps = {n: round(self.fap[n], 3) for n in range(3, FAP_COUNT + 1) if self.fap[n] != 0}
        return (f"Frame(viseme={self.viseme1},{self.viseme2},{self.viseme_blend} expression={self.expression1},"
                f"{self.intensity1},{self.expression2},{self.intensity2} faps={faps})")


class TimedFrame(ctypes.Structure):
    """A frame at `time`, ms."""

    _fields_ = [("time", c_double), ("frame", Frame)]


class Lids(ctypes.Structure):
    _fields_ = [("gaze", c_float * 3), ("slit", c_float), ("opening", c_float), ("gaze_share", c_float * 2),
                ("ball", c_float * 17)]


class Iris(ctypes.Structure):
    _fields_ = [("axis", c_float * 3), ("pupil_radius", c_float), ("iris_radius", c_float), ("bend", c_float)]


class Tongue(ctypes.Structure):
    _fields_ = [("origin", c_float * 3), ("left", c_float * 3), ("up", c_float * 3), ("half_width", c_float),
                ("roll_limit", c_float)]


class Companion(ctypes.Structure):
    _fields_ = [("point", c_uint8), ("leader", c_uint8), ("is_choice", c_uint8), ("reserved", c_uint8), ("share", c_float)]


class Rig(ctypes.Structure):
    _fields_ = [("viseme", POINTER(c_float)), ("expression", POINTER(c_float)), ("fapu", c_float * 5),
                ("eye_pivot", c_float * 3 * 2), ("head_pivot", c_float * 3), ("viseme_share", c_float), ("iris", Iris * 2),
                ("tongue", Tongue), ("companion", POINTER(Companion)), ("companion_count", c_uint32),
                ("lip_share", c_float), ("lids", Lids * 2)]


class Pose(ctypes.Structure):
    """Displacements of the feature points and motions of the rigid parts of one head; all members are floats."""

    _fields_ = [("fp", c_float * (FP_COUNT * 3)), ("eye_rotation", c_float * 4 * 2), ("eye_translation", c_float * 3 * 2),
                ("head_rotation", c_float * 4), ("eye_pivot", c_float * 3 * 2), ("head_pivot", c_float * 3),
                ("pupil_growth", c_float * 2), ("tongue_roll", c_float), ("iris", Iris * 2), ("tongue", Tongue),
                ("lid_closure", c_float * 2 * 2), ("lids", Lids * 2)]


class Face(ctypes.Structure):
    _fields_ = [("vertex_count", c_uint32), ("rest", POINTER(c_float)), ("row_offsets", POINTER(c_uint32)),
                ("row_points", POINTER(c_uint8)), ("row_weights", POINTER(c_float)), ("rigid", POINTER(c_uint8)),
                ("turn", POINTER(c_uint8))]


class Sized(ctypes.Structure):
    """A struct that begins with its own size."""

    def __init__(self, **members):
        super().__init__(size=ctypes.sizeof(type(self)), **members)


class Package(Sized):
    _fields_ = [("size", c_uint32), ("vertex_count", c_uint32), ("positions", POINTER(c_float)),
                ("mesh_sha256", c_char_p), ("triangles", POINTER(c_uint32)), ("normals", POINTER(c_float)),
                ("triangle_count", c_uint32), ("reserved", c_uint32), ("mesh_drc", c_char_p), ("mesh_drc_size", c_size_t),
                ("weights", c_char_p), ("weights_size", c_size_t), ("rig_json", c_char_p), ("rig_json_size", c_size_t)]


class HeadOptions(Sized):
    _fields_ = [("size", c_uint32), ("flags", c_uint32), ("viseme_share", c_float), ("jaw_takes_lip", c_uint32)]


class StreamOptions(Sized):
    _fields_ = [("size", c_uint32), ("role", c_uint32), ("take_over", c_uint32), ("max_message_bytes", c_uint32),
                ("retry_first", c_double), ("retry_longest", c_double), ("seed", c_uint64), ("ping_interval", c_double),
                ("silence_limit", c_double), ("batch", c_double), ("resume_epoch", c_uint64), ("resume_sequence", c_uint64),
                ("sound", c_uint32), ("text", c_uint32)]


class Event(Sized):
    _fields_ = [("size", c_uint32), ("type", c_uint32), ("state", c_uint32), ("code", c_uint32), ("resumed", c_uint32),
                ("is_final", c_uint32), ("epoch", c_uint64), ("sequence", c_uint64), ("media_time", c_double),
                ("round_trip", c_double), ("server_offset", c_double), ("error", Error),
                ("duration", c_double), ("packet", POINTER(c_uint8)), ("packet_size", c_uint32), ("reserved", c_uint32),
                ("text", c_char_p), ("language", c_char_p)]


class Header(Sized):
    _fields_ = [("size", c_uint32), ("resumed", c_uint32), ("epoch", c_uint64), ("sequence", c_uint64),
                ("media_time", c_double), ("server_time", c_double), ("frame_rate", c_double), ("batch_interval", c_double),
                ("viseme_share", c_double), ("stream", c_char_p), ("title", c_char_p), ("model", c_char_p),
                ("quantizer", POINTER(c_double)), ("sound_codec", c_uint32), ("sound_rate", c_uint32),
                ("sound_channels", c_uint32), ("sound_bitrate", c_uint32)]


class Clock(Sized):
    _fields_ = [("size", c_uint32), ("steps", c_uint32), ("media_time", c_double), ("uncertainty", c_double),
                ("drift", c_double), ("round_trip", c_double), ("server_offset", c_double)]


class PlayerOptions(Sized):
    _fields_ = [("size", c_uint32), ("eased", c_uint32), ("delay", c_double), ("max_frames", c_uint32), ("reserved", c_uint32)]


class PlayerStatistics(Sized):
    """What a player measures: `delay`, `wanted_delay`, `jitter`, `error`, `starved_time` in ms; `starved`, `snaps`, `held`."""

    _fields_ = [("size", c_uint32), ("held", c_uint32), ("delay", c_double), ("wanted_delay", c_double), ("jitter", c_double),
                ("error", c_double), ("starved_time", c_double), ("starved", c_uint64), ("snaps", c_uint64)]


class Moment(Sized):
    """What a player shows: `t` from frame 1 to frame 2 of `frames` (before, from, to, after), on a line or a curve."""

    _fields_ = [("size", c_uint32), ("is_curve", c_uint32), ("from_time", c_double), ("to_time", c_double),
                ("viseme_share", c_double), ("t", c_float), ("spans", c_float * 3), ("frames", Frame * 4)]


class TakeOptions(Sized):
    _fields_ = [("size", c_uint32), ("absent", c_uint32), ("gaps", c_uint32)]


class TakeWarning(Sized):
    _fields_ = [("size", c_uint32), ("oddity", c_uint32), ("line", c_uint32), ("count", c_uint32), ("message", c_char * 256)]


class ListenerOptions(Sized):
    _fields_ = [("size", c_uint32), ("sample_rate", c_uint32)]


class Heard(Sized):
    """What is heard in 10 ms: `level` in dB of full scale, `time` in ms, `weights` and `probability` of the visemes."""

    _fields_ = [("size", c_uint32), ("level", c_float), ("time", c_double), ("weights", c_float * VISEME_COUNT),
                ("probability", c_float * VISEME_COUNT)]


# Names of C structs, for the test of layouts.
structs = {
    "semblante_error": Error, "semblante_frame": Frame, "semblante_timed_frame": TimedFrame, "semblante_lids": Lids,
    "semblante_iris": Iris, "semblante_tongue": Tongue, "semblante_companion": Companion, "semblante_rig": Rig,
    "semblante_pose": Pose, "semblante_face": Face, "semblante_package": Package, "semblante_head_options": HeadOptions,
    "semblante_stream_options": StreamOptions, "semblante_event": Event, "semblante_header": Header,
    "semblante_clock": Clock, "semblante_player_options": PlayerOptions,
    "semblante_player_statistics": PlayerStatistics, "semblante_moment": Moment, "semblante_take_options": TakeOptions,
    "semblante_take_warning": TakeWarning, "semblante_listener_options": ListenerOptions, "semblante_heard": Heard,
}

_result = ctypes.c_int  # semblante_result
_handle = c_void_p
_made = POINTER(c_void_p)
_error = POINTER(Error)
_frame = POINTER(Frame)
_timed = POINTER(TimedFrame)
_count = POINTER(c_uint32)
_floats = c_void_p  # addresses of arrays are passed as numbers

functions = {  # name: (result, arguments)
    "semblante_sdk_version": (c_uint32, []),
    "semblante_result_name": (c_char_p, [_result]),
    "semblante_head_create": (_result, [POINTER(Package), POINTER(HeadOptions), _made, _error]),
    "semblante_head_destroy": (None, [_handle]),
    "semblante_head_vertex_count": (c_uint32, [_handle]),
    "semblante_head_rig": (POINTER(Rig), [_handle]),
    "semblante_head_face": (POINTER(Face), [_handle]),
    "semblante_head_triangles": (c_void_p, [_handle, _count]),
    "semblante_head_uvs": (c_void_p, [_handle]),
    "semblante_head_pose": (POINTER(Pose), [_handle]),
    "semblante_head_set_viseme_share": (_result, [_handle, c_float]),
    "semblante_head_set_frame": (_result, [_handle, _frame]),
    "semblante_head_set_interpolated": (_result, [_handle, _frame, _frame, c_float]),
    "semblante_head_get_pose": (_result, [_handle, POINTER(Pose)]),
    "semblante_head_set_pose": (_result, [_handle, POINTER(Pose)]),
    "semblante_head_positions": (_result, [_handle, _floats, c_size_t]),
    "semblante_head_update_positions": (_result, [_handle, POINTER(Pose), _floats, c_size_t]),
    "semblante_head_normals": (_result, [_handle, _floats, _floats, c_size_t]),
    "semblante_sha256": (_result, [c_char_p, c_size_t, POINTER(c_uint8 * 32)]),
    "semblante_frame_from_arkit": (_result, [POINTER(c_float), _frame, _error]),
    "semblante_arkit_from_frame": (_result, [_frame, POINTER(c_float)]),
    "semblante_frame_from_oculus": (_result, [POINTER(c_float), _frame, _error]),
    "semblante_oculus_from_frame": (_result, [_frame, POINTER(c_float)]),
    "semblante_arkit_name": (c_char_p, [c_uint32]),
    "semblante_oculus_name": (c_char_p, [c_uint32]),
    "semblante_stream_create": (_result, [POINTER(StreamOptions), _made, _error]),
    "semblante_stream_destroy": (None, [_handle]),
    "semblante_stream_start": (None, [_handle, c_double]),
    "semblante_stream_stop": (None, [_handle, c_double]),
    "semblante_stream_opened": (None, [_handle, c_double]),
    "semblante_stream_receive": (_result, [_handle, c_char_p, c_size_t, c_double]),
    "semblante_stream_closed": (None, [_handle, c_uint32, c_double]),
    "semblante_stream_tick": (None, [_handle, c_double]),
    "semblante_stream_wake_time": (c_double, [_handle]),
    "semblante_stream_take_bytes": (c_void_p, [_handle, POINTER(c_size_t)]),
    "semblante_stream_next_event": (c_uint32, [_handle, POINTER(Event)]),
    "semblante_stream_frames": (_timed, [_handle, _count]),
    "semblante_stream_get_state": (ctypes.c_int, [_handle]),
    "semblante_stream_header": (_result, [_handle, POINTER(Header)]),
    "semblante_stream_clock": (_result, [_handle, c_double, POINTER(Clock)]),
    "semblante_stream_measure_clock": (None, [_handle, c_double]),
    "semblante_stream_resume_point": (None, [_handle, POINTER(c_uint64), POINTER(c_uint64)]),
    "semblante_stream_publish": (_result, [_handle, _timed, c_uint32, c_double, c_double]),
    "semblante_player_create": (_result, [POINTER(PlayerOptions), _made, _error]),
    "semblante_player_destroy": (None, [_handle]),
    "semblante_player_follow": (_result, [_handle, _handle]),
    "semblante_player_push": (_result, [_handle, _timed, c_uint32, c_double]),
    "semblante_player_advance": (c_uint32, [_handle, c_double, c_double]),
    "semblante_player_move_to": (c_uint32, [_handle, c_double]),
    "semblante_player_show": (c_uint32, [_handle, _handle]),
    "semblante_player_between": (_result, [_handle, _timed, _timed, POINTER(c_float)]),
    "semblante_player_moment": (_result, [_handle, POINTER(Moment)]),
    "semblante_player_time": (c_double, [_handle]),
    "semblante_player_stats": (_result, [_handle, POINTER(PlayerStatistics)]),
    "semblante_player_clear": (None, [_handle]),
    "semblante_performance_create": (_result, [c_char_p, c_size_t, _made, _error]),
    "semblante_performance_destroy": (None, [_handle]),
    "semblante_performance_name": (c_char_p, [_handle]),
    "semblante_performance_duration": (c_double, [_handle]),
    "semblante_performance_frame_at": (_result, [_handle, c_double, c_double, _frame]),
    "semblante_take_read": (_result, [c_uint32, c_char_p, c_size_t, POINTER(TakeOptions), _made, _error]),
    "semblante_take_destroy": (None, [_handle]),
    "semblante_take_frames": (_timed, [_handle, _count]),
    "semblante_take_frame_rate": (c_double, [_handle]),
    "semblante_take_warning_count": (c_uint32, [_handle]),
    "semblante_take_get_warning": (_result, [_handle, c_uint32, POINTER(TakeWarning)]),
    "semblante_take_write": (_result, [c_uint32, _timed, c_uint32, c_double, c_char_p, POINTER(c_size_t), _error]),
    "semblante_stream_spoken": (_result, [_handle, c_uint32, c_uint64, c_uint32, c_double]),
    "semblante_speaker_create": (_result, [c_uint32, _made, _error]),
    "semblante_speaker_destroy": (None, [_handle]),
    "semblante_speaker_say": (_result, [_handle, POINTER(c_uint8), c_size_t, c_uint32, c_double]),
    "semblante_speaker_reach": (None, [_handle, c_uint32, c_double]),
    "semblante_speaker_end": (None, [_handle, c_double]),
    "semblante_speaker_show": (c_uint32, [_handle, c_double, POINTER(Frame)]),
    "semblante_listener_create": (_result, [POINTER(ListenerOptions), _made, _error]),
    "semblante_listener_destroy": (None, [_handle]),
    "semblante_listener_push": (_result, [_handle, POINTER(c_float), c_uint32, _count, POINTER(Heard)]),
    "semblante_interpolate": (None, [POINTER(Pose), POINTER(Pose), c_float, POINTER(Pose)]),
}


def _load():
    library = ctypes.CDLL(_find())
    for name, (result, arguments) in functions.items():
        function = getattr(library, name)
        function.restype = result
        function.argtypes = arguments
    found = library.semblante_sdk_version()
    if found >> 8 != VERSION >> 8:  # the last byte only adds
        raise ImportError(f"libsemblante has version {found:#08x}, this package needs {VERSION:#08x}")
    return library


library = _load()
