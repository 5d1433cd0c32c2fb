"""Faces of other systems: ARKit's 52 blend shapes and the 15 visemes of Oculus Lipsync."""

import ctypes
from typing import Any, Dict, Mapping, Sequence, Tuple, Union

from ._library import library
from ._structs import Error, Frame
from .errors import check

ARKIT_NAMES: Tuple[str, ...] = tuple(library.semblante_arkit_name(i).decode() for i in range(52))
# In the order of Oculus Lipsync, which is that of FAP 1.
OCULUS_NAMES: Tuple[str, ...] = tuple(library.semblante_oculus_name(i).decode() for i in range(15))


Values = Union[Mapping[str, float], Sequence[float]]


def _numbers(values: Values, names: Tuple[str, ...], kind: str) -> Any:
    if isinstance(values, Mapping):
        unknown = set(values) - set(names)
        if unknown:
            raise ValueError(f"{kind} has no {', '.join(sorted(unknown))}")
        values = [values.get(name, 0.0) for name in names]
    if len(values) != len(names):
        raise ValueError(f"{kind} has {len(names)} values, not {len(values)}")
    return (ctypes.c_float * len(names))(*values)


def from_arkit(coefficients: Values) -> Frame:
    """A Frame of coefficients: {name: 0..1}, or 52 numbers in the order of ARKIT_NAMES."""
    frame, error = Frame(), Error()
    numbers = _numbers(coefficients, ARKIT_NAMES, "ARKit")
    check(library.semblante_frame_from_arkit(numbers, ctypes.byref(frame), ctypes.byref(error)), error)
    return frame


def to_arkit(frame: Frame) -> Dict[str, float]:
    """{name: coefficient 0..1} of a Frame."""
    numbers = (ctypes.c_float * 52)()
    check(library.semblante_arkit_from_frame(ctypes.byref(frame), numbers))
    return dict(zip(ARKIT_NAMES, numbers))


def from_oculus(weights: Values) -> Frame:
    """A Frame of weights: {name: weight}, or 15 numbers in the order of OCULUS_NAMES."""
    frame, error = Frame(), Error()
    numbers = _numbers(weights, OCULUS_NAMES, "Oculus Lipsync")
    check(library.semblante_frame_from_oculus(numbers, ctypes.byref(frame), ctypes.byref(error)), error)
    return frame


def to_oculus(frame: Frame) -> Dict[str, float]:
    """{name: weight} of the visemes of a Frame, with sum 1."""
    numbers = (ctypes.c_float * 15)()
    check(library.semblante_oculus_from_frame(ctypes.byref(frame), numbers))
    return dict(zip(OCULUS_NAMES, numbers))
