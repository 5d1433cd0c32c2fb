"""A face package and its current pose."""

import ctypes
import numbers
from typing import Any, Dict, Mapping, Optional, Sequence, Tuple, Union

from . import arrays
from ._library import library
from ._structs import Frame, HeadOptions, Package, Pose
from .errors import Owner, check, make


class Head(Owner):
    """One parametrized head. A frame of face parameters goes in, vertices come out."""

    _destroy = library.semblante_head_destroy

    def __init__(self, mesh_drc: bytes, weights: bytes, rig_json: Union[str, bytes], *, viseme_share: float = 0.0,
                 jaw_takes_lip: bool = False) -> None:
        """From the bytes of the artefacts mesh.drc, weights and rig.json, which must belong together. `viseme_share`: see
        `set_viseme_share`; 0 takes that of rig.json. `jaw_takes_lip`: FAP 3 alone takes the lower lip along. Raises
        SemblanteError: malformed, unsupported, mismatch, too_large, out_of_memory."""
        mesh_drc, weights = bytes(mesh_drc), bytes(weights)
        rig_json = rig_json.encode() if isinstance(rig_json, str) else bytes(rig_json)
        address = ctypes.POINTER(ctypes.c_uint8)
        package = Package(mesh_drc=ctypes.cast(ctypes.c_char_p(mesh_drc), address), mesh_drc_size=len(mesh_drc),
                          weights=ctypes.cast(ctypes.c_char_p(weights), address), weights_size=len(weights),
                          rig_json=rig_json, rig_json_size=len(rig_json))
        options = HeadOptions(viseme_share=viseme_share, jaw_takes_lip=int(jaw_takes_lip))
        super().__init__(make(library.semblante_head_create, ctypes.byref(package), ctypes.byref(options)))
        self.vertex_count: int = library.semblante_head_vertex_count(self._handle)
        self._positions, self._at = arrays.new("f", (self.vertex_count, 3))
        self._normals: Optional[Tuple[Any, int]] = None
        self._shown = Pose()  # the pose of _positions
        self._read = False

    @property
    def triangles(self) -> Any:
        """#T by 3 vertex indices."""
        count = ctypes.c_uint32()
        address = library.semblante_head_triangles(self._handle, ctypes.byref(count))
        return arrays.view(address, "I", (count.value, 3), self._memory) if address else arrays.new("I", (0, 3))[0]

    @property
    def uvs(self) -> Optional[Any]:
        """#V by 2, origin top left; None if the mesh has none."""
        address = library.semblante_head_uvs(self._handle)
        return arrays.view(address, "f", (self.vertex_count, 2), self._memory) if address else None

    @property
    def colors(self) -> Optional[Any]:
        """#V by 3 bytes: red, green, blue, sRGB; they multiply material and image as linear light. None, which is white, if
        the mesh has none."""
        address = library.semblante_head_colors(self._handle)
        return arrays.view(address, "B", (self.vertex_count, 3), self._memory) if address else None

    @property
    def neutral(self) -> Any:
        """#V by 3: the vertices of the neutral face, model units."""
        face = library.semblante_head_face(self._handle).contents
        return arrays.view(ctypes.addressof(face.rest.contents), "f", (self.vertex_count, 3), self._memory)

    @property
    def fapu(self) -> Dict[str, float]:
        """{name: model units of one FAP unit}; a unit that the head does not have is 0."""
        rig = library.semblante_head_rig(self._handle).contents
        return dict(zip(("IRISD", "ES", "ENS", "MNS", "MW"), rig.fapu))

    @property
    def pose(self) -> Pose:
        """The current pose. A view: it changes with the head."""
        pose: Any = library.semblante_head_pose(self._handle).contents
        pose.owner = self._memory
        shown: Pose = pose
        return shown

    def set_viseme_share(self, share: float) -> None:
        """0..1: the share of the viseme at a point that an expression moves too (Eq. 5), for frames set from now on."""
        check(library.semblante_head_set_viseme_share(self._handle, share))

    def set_frame(self, frame: Frame) -> None:
        """Sets the pose to that of a Frame (Eq. 5, 6). FAPs must be finite."""
        check(library.semblante_head_set_frame(self._handle, ctypes.byref(frame)))

    def set_interpolated(self, start: Frame, end: Frame, t: float) -> None:
        """Sets the pose at t, 0..1, between two frames."""
        check(library.semblante_head_set_interpolated(self._handle, ctypes.byref(start), ctypes.byref(end), t))

    def set_pose(self, pose: Pose) -> None:
        """Sets a pose made by the caller."""
        check(library.semblante_head_set_pose(self._handle, ctypes.byref(pose)))

    def positions(self) -> Any:
        """#V by 3: the vertices of the current pose (Eq. 7), model units, in the order of the decoded mesh. The array is the
        head's own: the next call changes it."""
        size = 3 * self.vertex_count
        pose = library.semblante_head_pose(self._handle).contents
        if self._read:
            check(library.semblante_head_update_positions(self._handle, ctypes.byref(self._shown), self._at, size))
        else:
            check(library.semblante_head_positions(self._handle, self._at, size))
        ctypes.memmove(ctypes.byref(self._shown), ctypes.byref(pose), ctypes.sizeof(Pose))
        self._read = True
        return self._positions

    def normals(self) -> Any:
        """#V by 3 unit normals of `positions()`. The array is the head's own."""
        positions = self.positions()
        if self._normals is None:
            self._normals = arrays.new("f", (self.vertex_count, 3))
        check(library.semblante_head_normals(self._handle, self._at, self._normals[1], len(positions) * 3))
        return self._normals[0]


Viseme = Union[int, Tuple[int, int, float]]
Expression = Tuple[int, float]


def frame(faps: Optional[Mapping[int, float]] = None, *, viseme: Optional[Viseme] = None,
          expression: Optional[Union[Expression, Sequence[Expression]]] = None) -> Frame:
    """A Frame. `faps`: {number: FAP units}. `viseme`: number of 0..14 at full strength, or (first, second, share of the first).
    `expression`: (number of 1..6, intensity 0..1), or two such pairs."""
    made = Frame()
    for number, value in (faps or {}).items():
        if not isinstance(number, numbers.Integral) or not 3 <= number < len(made.fap):
            raise ValueError(f"FAP {number!r} is not one of 3 to {len(made.fap) - 1}")
        made.fap[number] = value
    if viseme is not None:
        mixed: Any = (viseme, 0, 1.0) if isinstance(viseme, numbers.Integral) else viseme
        if isinstance(mixed, str) or len(mixed) != 3:
            raise ValueError(f"viseme {viseme!r} is neither a number nor (first, second, share of the first)")
        first, second, share = mixed
        made.viseme1, made.viseme2 = _one_of("viseme", first, 14), _one_of("viseme", second, 14)
        made.viseme_blend = _sixty_thirds(share)
    if expression is not None:
        pairs: Any = [] if isinstance(expression, (str, numbers.Number)) else list(expression)
        if pairs and isinstance(pairs[0], numbers.Integral):
            pairs = [pairs]
        if not 1 <= len(pairs) <= 2 or any(isinstance(pair, str) or len(pair) != 2 for pair in pairs):
            raise ValueError(f"expression {expression!r} is neither (number, intensity) nor two such pairs")
        for slot, (number, intensity) in enumerate(pairs, 1):
            setattr(made, f"expression{slot}", _one_of("expression", number, 6))
            setattr(made, f"intensity{slot}", _sixty_thirds(intensity))
    return made


def _one_of(what: str, number: int, most: int) -> int:
    if not isinstance(number, numbers.Integral) or not 0 <= number <= most:
        raise ValueError(f"{what} {number!r} is not one of 0 to {most}")
    return number


def _sixty_thirds(share: float) -> int:
    if not 0 <= share <= 1:
        raise ValueError(f"{share} is not between 0 and 1")
    return round(63 * share)
