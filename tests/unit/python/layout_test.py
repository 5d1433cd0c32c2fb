"""The declarations for ctypes are those of the header: every member of every struct lies where the C compiler puts it, and
every function of the library is declared."""

import ctypes
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(TOP / "clients/python"))

from semblante import _library, _structs  # noqa: E402

HEADERS = ["clients/runtime/semblante.h", "core/kernel/semblante_kernel.h", "core/kernel/semblante_normals.h"]


def compiled(lines):
    """What a C program prints that includes the header and has these lines in main."""
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder, "layout.c")
        source.write_text('#include "clients/runtime/semblante.h"\n#include <stdio.h>\nint main(void) {\n' + "\n".join(lines) +
                          "\nreturn 0; }\n")
        program = pathlib.Path(folder, "layout")
        subprocess.run([os.environ.get("CC", "cc"), "-std=c99", "-I", TOP, source, "-o", program], check=True)
        return subprocess.run([program], check=True, capture_output=True, text=True).stdout.split("\n")[:-1]


class Layout(unittest.TestCase):
    def test_structs_have_the_members_where_C_has_them(self):
        lines, expected = [], []
        for name, struct in _structs.structs.items():
            lines.append(f'printf("{name} %zu\\n", sizeof(struct {name}));')
            expected.append(f"{name} {ctypes.sizeof(struct)}")
            for member, *_ in struct._fields_:
                size = getattr(struct, member).size
                lines.append(f'printf("{name}.{member} %zu %zu\\n", offsetof(struct {name}, {member}),'
                             f" sizeof(((struct {name}*)0)->{member}));")
                expected.append(f"{name}.{member} {getattr(struct, member).offset} {size}")
        self.assertEqual(compiled(lines), expected)

    def test_every_struct_of_the_header_is_declared(self):
        text = "".join((TOP / header).read_text() for header in HEADERS)
        named = set(re.findall(r"^typedef struct (semblante_\w+) \{", text, re.M))
        self.assertGreater(len(named), 15)
        self.assertEqual(named, set(_structs.structs))

    def test_every_function_of_the_header_is_declared(self):
        text = re.sub(r"/\*.*?\*/", "", (TOP / HEADERS[0]).read_text(), flags=re.S)
        named = set(re.findall(r"\b(semblante_\w+)\(", text))
        self.assertGreater(len(named), 50)
        self.assertEqual(named - set(_library.functions), set())

    def test_the_version_is_that_of_the_header(self):
        self.assertEqual(compiled(['printf("%u\\n", SEMBLANTE_SDK_VERSION);']), [str(_library.VERSION)])


if __name__ == "__main__":
    unittest.main(verbosity=2)
