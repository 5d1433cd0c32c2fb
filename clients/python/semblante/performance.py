"""Performances and takes: a face over time from a document or a file."""

import ctypes
import enum
from typing import Any, List, Optional, Sequence, Union

from ._library import library
from ._structs import Error, Frame, TakeOptions, TakeWarning, TimedFrame
from .errors import Owner, check, make


class Performance(Owner):
    """A performance document (protocol/SPEC.md, section 9): the face at any time."""

    _destroy = library.semblante_performance_destroy

    def __init__(self, document: Union[str, bytes]) -> None:
        """`document`: JSON as text or bytes. Raises SemblanteError whose `where` is the JSON pointer."""
        text = document.encode() if isinstance(document, str) else bytes(document)
        super().__init__(make(library.semblante_performance_create, text, len(text)))

    @property
    def name(self) -> str:
        return str(library.semblante_performance_name(self._handle), "utf-8")

    @property
    def duration(self) -> float:
        """ms; 0: endless."""
        return float(library.semblante_performance_duration(self._handle))

    def frame_at(self, ms: float, idle_ms: Optional[float] = None) -> Frame:
        """The Frame at `ms`. `idle_ms`: time of idle life, if the cues are looped."""
        frame = Frame()
        idle_ms = ms if idle_ms is None else idle_ms
        check(library.semblante_performance_frame_at(self._handle, ms, idle_ms, ctypes.byref(frame)))
        return frame


class TakeFormat(enum.IntEnum):
    FAP = 0
    LIVE_LINK_CSV = 1


class Take(Owner):
    """A file of recorded motion: .fap, or the CSV of Live Link Face."""

    _destroy = library.semblante_take_destroy

    def __init__(self, text: Union[str, bytes], format: TakeFormat = TakeFormat.FAP, keep_absent: bool = False,
                 interpolate_gaps: bool = False) -> None:
        """Of a .fap file: `keep_absent` lets a FAP that a frame omits keep its value (else it is zero); `interpolate_gaps`
        lets the face move where frame numbers are left out (else it holds still)."""
        text = text.encode() if isinstance(text, str) else bytes(text)
        options = TakeOptions(absent=int(keep_absent), gaps=int(interpolate_gaps))
        super().__init__(make(library.semblante_take_read, int(format), text, len(text), ctypes.byref(options)))

    @property
    def frames(self) -> Sequence[TimedFrame]:
        """The TimedFrames by rising time from the start, ms: a view that lives as long as the take."""
        count = ctypes.c_uint32()
        first = library.semblante_take_frames(self._handle, ctypes.byref(count))
        if not first:
            return ()
        block: Any = (TimedFrame * count.value).from_address(ctypes.addressof(first.contents))
        block.owner = self._memory
        frames: Sequence[TimedFrame] = block
        return frames

    @property
    def frame_rate(self) -> float:
        return float(library.semblante_take_frame_rate(self._handle))

    @property
    def warnings(self) -> List[TakeWarning]:
        """What deviates from the format and was accepted, in words."""
        found = []
        for i in range(library.semblante_take_warning_count(self._handle)):
            warning = TakeWarning()
            check(library.semblante_take_get_warning(self._handle, i, ctypes.byref(warning)))
            found.append(warning)
        return found


def write_take(frames: Sequence[TimedFrame], format: TakeFormat = TakeFormat.FAP, rate: float = 0.0) -> bytes:
    """The bytes of a file from TimedFrames by rising time. `rate`: frames per second; 0: by the times."""
    block = (TimedFrame * len(frames))(*frames)
    size, error = ctypes.c_size_t(0), Error()
    library.semblante_take_write(int(format), block, len(frames), rate, None, ctypes.byref(size), ctypes.byref(error))
    text = ctypes.create_string_buffer(max(size.value, 1))
    check(library.semblante_take_write(int(format), block, len(frames), rate, text, ctypes.byref(size), ctypes.byref(error)),
          error)
    return text.raw[:size.value]
