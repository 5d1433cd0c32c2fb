"""Frames of a stream to the pose to show now."""

import ctypes
import math
from typing import Optional, Sequence, Tuple

from ._library import library
from ._structs import PlayerOptions, PlayerStatistics, TimedFrame
from .errors import Owner, check, make
from .head import Head
from .stream import Stream


class Player(Owner):
    """Plays the frames of a stream with a small delay, at the display's rate, and never backwards."""

    _destroy = library.semblante_player_destroy

    def __init__(self, *, delay: float = 0.0, eased: bool = False, max_frames: int = 0) -> None:
        """`delay`: ms behind the stream's clock; 0: as short as the network allows. `eased`: smooth curves between frames."""
        options = PlayerOptions(delay=delay, eased=int(eased), max_frames=max_frames)
        super().__init__(make(library.semblante_player_create, ctypes.byref(options)))
        self._stream: Optional[Stream] = None

    def follow(self, stream: Optional[Stream]) -> None:
        """Plays the frames of a Stream from now on; None: of nobody."""
        check(library.semblante_player_follow(self._handle, stream._handle if stream else None))
        self._stream = stream  # lives as long as it is followed

    def push(self, frames: Sequence[TimedFrame], now: float) -> None:
        """TimedFrames by rising absolute time, without a stream."""
        block = (TimedFrame * len(frames))(*frames)
        check(library.semblante_player_push(self._handle, block, len(frames), now))

    def advance(self, now: float, elapsed: float = -1.0) -> bool:
        """Advances to the display frame at `now`, ms. `elapsed`: since the one before by the display's own rate, if it has
        one. True when there is something to show."""
        return bool(library.semblante_player_advance(self._handle, now, elapsed))

    def move_to(self, media_time: float) -> bool:
        """Instead of `advance` with a clock of the caller's, such as that of a sound."""
        return bool(library.semblante_player_move_to(self._handle, media_time))

    def show(self, head: Head) -> bool:
        """Sets the pose of a Head to the current moment. True if it changed."""
        return bool(library.semblante_player_show(self._handle, head._handle))

    def between(self) -> Optional[Tuple[TimedFrame, TimedFrame, float]]:
        """The current moment as (frame, frame, position between them 0..1); None before the first frame."""
        start, end, t = TimedFrame(), TimedFrame(), ctypes.c_float()
        result = library.semblante_player_between(self._handle, ctypes.byref(start), ctypes.byref(end), ctypes.byref(t))
        return (start, end, t.value) if result == 0 else None

    @property
    def time(self) -> Optional[float]:
        """The media time to show, ms; None before the first frame."""
        time = library.semblante_player_time(self._handle)
        return None if math.isnan(time) else time

    @property
    def statistics(self) -> PlayerStatistics:
        statistics = PlayerStatistics()
        check(library.semblante_player_stats(self._handle, ctypes.byref(statistics)))
        return statistics

    def clear(self) -> None:
        """Drops all frames."""
        library.semblante_player_clear(self._handle)
