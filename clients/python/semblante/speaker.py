"""The face of a client whose own voice says the text of a stream."""

import ctypes
from typing import Optional

from ._library import library
from ._structs import Frame
from .errors import Owner, check, make


class Speaker(Owner):
    """For TEXT events of a Stream: `say` when the voice begins a text, `reach` when it begins a word, `end` when it is silent."""

    _destroy = library.semblante_speaker_destroy

    def __init__(self, seed: int = 0) -> None:
        """`seed`: of its blinks, nods and glances."""
        super().__init__(make(library.semblante_speaker_create, seed))

    def say(self, score: bytes, now: float, first_word: int = 0) -> None:
        """The voice begins at a word (from 0) of the text with this score."""
        block = (ctypes.c_uint8 * len(score)).from_buffer_copy(score)
        check(library.semblante_speaker_say(self._handle, block, len(score), first_word, now))

    def reach(self, word: int, now: float) -> None:
        library.semblante_speaker_reach(self._handle, word, now)

    def end(self, now: float) -> None:
        library.semblante_speaker_end(self._handle, now)

    def show(self, now: float, frame: Optional[Frame] = None) -> Optional[Frame]:
        """The frame, or a neutral one, with the mouth, expression and lids of what is said; None when nothing is said."""
        shown = Frame() if frame is None else frame
        return shown if library.semblante_speaker_show(self._handle, now, ctypes.byref(shown)) else None
