"""The shared library of the runtime and the functions of clients/runtime/semblante.h with their types; the structs are in
_structs.py. tests/unit/python compares both with the header as a C compiler reads it.
"""

import ctypes
import ctypes.util
import os
import pathlib
from typing import Any, Dict, List, Tuple
from ctypes import POINTER, c_char_p, c_double, c_float, c_size_t, c_uint8, c_uint32, c_uint64, c_void_p

from ._structs import (Clock, Error, Event, Face, Frame, HeadOptions, Header, Heard, ListenerOptions, Moment, Package,
                       PlayerOptions, PlayerStatistics, Pose, Rig, StreamOptions, TakeOptions, TakeWarning, TimedFrame)

VERSION = 0x000200  # SEMBLANTE_SDK_VERSION that the declarations were written for


def _find() -> str:
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


def _describe(frame: Frame) -> str:
    faps = {n: round(level, 3) for n, level in enumerate(frame.fap) if n >= 3 and level != 0}
    return (f"Frame(viseme={frame.viseme1},{frame.viseme2},{frame.viseme_blend} expression={frame.expression1},"
            f"{frame.intensity1},{frame.expression2},{frame.intensity2} faps={faps})")


setattr(Frame, "__repr__", _describe)

_result = ctypes.c_int  # semblante_result
_handle = c_void_p
_made = POINTER(c_void_p)
_error = POINTER(Error)
_frame = POINTER(Frame)
_timed = POINTER(TimedFrame)
_count = POINTER(c_uint32)
_floats = c_void_p  # addresses of arrays are passed as numbers

functions: Dict[str, Tuple[Any, List[Any]]] = {  # name: (result, arguments)
    "semblante_sdk_version": (c_uint32, []),
    "semblante_result_name": (c_char_p, [_result]),
    "semblante_head_create": (_result, [POINTER(Package), POINTER(HeadOptions), _made, _error]),
    "semblante_head_destroy": (None, [_handle]),
    "semblante_head_vertex_count": (c_uint32, [_handle]),
    "semblante_head_rig": (POINTER(Rig), [_handle]),
    "semblante_head_face": (POINTER(Face), [_handle]),
    "semblante_head_triangles": (c_void_p, [_handle, _count]),
    "semblante_head_uvs": (c_void_p, [_handle]),
    "semblante_head_colors": (c_void_p, [_handle]),
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
    "semblante_stream_publish_sound": (_result, [_handle, c_char_p, c_uint32, c_double]),
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
    "semblante_stream_set_captions": (_result, [_handle, c_uint32]),
    "semblante_score_words": (_result, [POINTER(c_uint8), c_uint32, POINTER(c_double), _count]),
    "semblante_speaker_create": (_result, [c_uint32, _made, _error]),
    "semblante_speaker_destroy": (None, [_handle]),
    "semblante_speaker_say": (_result, [_handle, POINTER(c_uint8), c_size_t, c_uint32, c_double]),
    "semblante_speaker_reach": (None, [_handle, c_uint32, c_double]),
    "semblante_speaker_end": (None, [_handle, c_double]),
    "semblante_speaker_show": (c_uint32, [_handle, c_double, POINTER(Frame)]),
    "semblante_speaker_unpack": (c_size_t, [POINTER(c_uint8), c_size_t, POINTER(c_uint8), c_size_t]),
    "semblante_listener_create": (_result, [POINTER(ListenerOptions), _made, _error]),
    "semblante_listener_destroy": (None, [_handle]),
    "semblante_listener_push": (_result, [_handle, POINTER(c_float), c_uint32, _count, POINTER(Heard)]),
    "semblante_interpolate": (None, [POINTER(Pose), POINTER(Pose), c_float, POINTER(Pose)]),
}


def _load() -> ctypes.CDLL:
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
