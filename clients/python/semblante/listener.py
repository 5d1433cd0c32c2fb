"""Visemes of the sound of speech, while it goes on."""

import ctypes
from typing import Any, List, Sequence

from ._library import library
from ._structs import Heard, ListenerOptions
from .errors import Owner, check, make

_NOTHING_NEW = 9  # SEMBLANTE_UNAVAILABLE


class Listener(Owner):
    """Hears visemes in speech of any language. Its answers are 52.5 ms behind the sound."""

    _destroy = library.semblante_listener_destroy

    def __init__(self, sample_rate: int) -> None:
        """`sample_rate`: 8000 to 192000 Hz."""
        options = ListenerOptions(sample_rate=int(sample_rate))
        super().__init__(make(library.semblante_listener_create, ctypes.byref(options)))

    def push(self, samples: Any) -> List[Heard]:
        """What is heard in the next samples: a Heard for each 10 ms. `samples`: floats of one channel, of full scale 1, as a
        sequence or anything with a buffer of floats of 32 bits (numpy, array.array('f'))."""
        try:
            view: Sequence[float] = memoryview(samples).cast("B").cast("f")
        except TypeError:
            view = list(samples)
        block = (ctypes.c_float * len(view))(*view)
        found: List[Heard] = []
        at, taken = 0, ctypes.c_uint32()
        while True:
            heard = Heard()
            rest = ctypes.cast(ctypes.byref(block, 4 * at), ctypes.POINTER(ctypes.c_float))
            result = library.semblante_listener_push(self._handle, rest, len(view) - at, ctypes.byref(taken), ctypes.byref(heard))
            at += taken.value
            if result == _NOTHING_NEW:
                return found
            check(result)
            found.append(heard)
