"""Errors of the library as exceptions."""

import ctypes
from typing import Any, Callable, ClassVar, NoReturn, Optional, SupportsIndex, Tuple, TypeVar

from ._library import library
from ._structs import Error


class SemblanteError(Exception):
    """`code`: the name of the result, such as "malformed"; `where`: the member or byte at fault, may be empty."""

    def __init__(self, code: str, where: str, message: str) -> None:
        super().__init__(": ".join(part for part in (where, message or code) if part))
        self.code = code
        self.where = where


def check(result: int, error: Optional[Error] = None) -> None:
    """Raises SemblanteError unless `result` is OK. `error`: the struct that the function has filled."""
    if result == 0:
        return
    code = library.semblante_result_name(result).decode()
    if error is None:
        raise SemblanteError(code, "", "")
    raise SemblanteError(code, error.where.decode("utf-8", "replace"), error.message.decode("utf-8", "replace"))


def make(function: Callable[..., int], *arguments: Any) -> ctypes.c_void_p:
    """Calls a function `..._create(arguments..., handle, error)` and returns the handle."""
    handle = ctypes.c_void_p()
    error = Error()
    check(function(*arguments, ctypes.byref(handle), ctypes.byref(error)), error)
    return handle


_Self = TypeVar("_Self", bound="Owner")


class Memory:
    """A handle of the library, destroyed with the last reference to it: that of its object, and those of views."""

    def __init__(self, handle: ctypes.c_void_p, destroy: Callable[[ctypes.c_void_p], None]) -> None:
        self.handle = handle
        self._destroy = destroy

    def __del__(self) -> None:
        self._destroy(self.handle)

    def __reduce__(self) -> Tuple[Any, ...]:
        return type(None), ()  # a copy of a view has its own numbers


class Owner:
    """Owns a handle of the library, until it is closed or collected."""

    _destroy: ClassVar[Callable[[ctypes.c_void_p], None]]
    _held: Optional[Memory] = None

    def __init__(self, handle: ctypes.c_void_p) -> None:
        self._held = Memory(handle, type(self)._destroy)

    @property
    def _memory(self) -> Memory:
        if self._held is None:
            raise ValueError(f"this {type(self).__name__} is closed")
        return self._held

    @property
    def _handle(self) -> ctypes.c_void_p:
        return self._memory.handle

    def close(self) -> None:
        """Frees the memory, once no view of it is left. The object must not be used afterwards."""
        self._held = None

    def __reduce_ex__(self, protocol: SupportsIndex) -> NoReturn:
        raise TypeError(f"a {type(self).__name__} is memory of the library: it cannot be copied or pickled")  # freed twice

    def __enter__(self: _Self) -> _Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
