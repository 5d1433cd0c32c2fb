"""Memory of the library as arrays without a copy: numpy's where numpy is installed, else memoryviews of the same shape."""

import ctypes
from typing import Any, Dict, Optional, Tuple

numpy: Any
try:
    import numpy
except ImportError:  # everything works without
    numpy = None

_formats: Dict[str, Any] = {"f": ctypes.c_float, "I": ctypes.c_uint32, "B": ctypes.c_uint8, "d": ctypes.c_double}


def view(address: int, kind: str, shape: Tuple[int, ...], owner: Optional[object] = None) -> Any:
    """An array of `kind` ("f", "I", "B", "d") at the address. `owner`: what must live as long as the array."""
    count = 1
    for n in shape:
        count *= n
    block: Any = (_formats[kind] * count).from_address(address)
    block.owner = owner
    if numpy is not None:
        return numpy.frombuffer(block, dtype=kind).reshape(shape)
    flat = memoryview(block).cast("B").cast(kind)
    return flat if len(shape) == 1 else flat.cast("B").cast(kind, shape)


def new(kind: str, shape: Tuple[int, ...]) -> Tuple[Any, int]:
    """A zeroed array, and its address."""
    count = 1
    for n in shape:
        count *= n
    block = (_formats[kind] * count)()
    return view(ctypes.addressof(block), kind, shape, block), ctypes.addressof(block)
