"""A face package to a moving face in an OBJ file: hello_face.py FOLDER OUT.obj

FOLDER holds mesh.drc, weights and rig.json, as `semblante parametrize --out FOLDER` or three downloads leave them.
"""

import pathlib
import sys

import semblante

folder, out = map(pathlib.Path, sys.argv[1:3])
head = semblante.Head(*((folder / name).read_bytes() for name in ("mesh.drc", "weights", "rig.json")))
head.set_frame(semblante.frame({3: 120}, viseme=10, expression=(1, 0.6)))  # "a", a little joy, the jaw a little lower
places = head.positions().tolist()
colors = [[]] * len(places) if head.colors is None else [[channel / 255 for channel in color] for color in head.colors.tolist()]
with open(out, "w") as file:
    file.writelines("v " + " ".join(f"{x:.6g}" for x in place + color) + "\n" for place, color in zip(places, colors))
    file.writelines(f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in head.triangles.tolist())
print(f"{head.vertex_count} vertices, FAPUs {head.fapu}")
