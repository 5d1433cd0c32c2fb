"""libsemblante for other machines: built for aarch64 and run under an emulator, and compiled for phones as far as that goes here.

Run by `tests/run --aarch64`. Beside Debian's cross compiler it takes Draco for arm64 from the mirror, into the build folder."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import golden_streams

TOP = golden_streams.TOP
BUILD = pathlib.Path(os.environ.get("SEMBLANTE_BUILD", TOP / "build")).resolve()
HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = TOP / "clients/runtime/examples"
FACE = TOP / "protocol/vectors/face"
EMULATOR = shutil.which("qemu-aarch64-static") or shutil.which("qemu-aarch64")
STRICT = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"]

# Draco's decoder fuses sums on aarch64, so that vertices of the mesh differ in the last bit. Of the largest coordinate, and of 1.
MAX_POSITION_DIFFERENCE = 2.0**-22
MAX_NORMAL_DIFFERENCE = 1e-4


def run(*arguments, **options):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, timeout=1800, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}")
    return done.stdout


def draco_for_arm64():
    """The folder of its libraries, unpacked in the build folder."""
    root = BUILD / "aarch64/packages"
    run(TOP / "deploy/lib/arm64_packages.sh", root, "libdraco-dev", "libdraco7")
    return root / "usr/lib/aarch64-linux-gnu"


def compile_program(compiler, source, prefix, output, *libraries):
    run(compiler, *STRICT, f"-I{prefix}/include", f"-I{EXAMPLES}", source, *libraries, "-o", output)


def numbers(text, convert):
    """(words, numbers) of the lines of a text."""
    for line in text.splitlines():
        word, *values = line.split()
        yield word, [convert(v) for v in values]


class Aarch64(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if EMULATOR is None or shutil.which("aarch64-linux-gnu-g++") is None:
            raise unittest.SkipTest("g++-aarch64-linux-gnu or qemu-user-static is not installed")
        cls.folder = BUILD / "aarch64"
        cls.draco = draco_for_arm64()
        run("cmake", "-S", TOP, "-B", cls.folder / "runtime", "-G", "Ninja", "-DSEMBLANTE_RUNTIME_ONLY=ON", "-DSEMBLANTE_DRACO=ON",
            "--toolchain", TOP / "deploy/cmake/aarch64-linux-gnu.cmake", f"-Ddraco_DIR={cls.draco}/cmake/draco")
        run("cmake", "--build", cls.folder / "runtime")
        cls.prefix, cls.host = cls.folder / "prefix", cls.folder / "host"
        for build, prefix in ((cls.folder / "runtime", cls.prefix), (BUILD, cls.host)):
            shutil.rmtree(prefix, ignore_errors=True)
            run("cmake", "--install", build, "--prefix", prefix, "--component", "runtime")
        for name, source in (("hello_face", EXAMPLES / "hello_face.c"), ("probe", HERE / "probe.c")):
            compile_program("aarch64-linux-gnu-gcc", source, cls.prefix, cls.folder / name, "-static", f"-L{cls.prefix}/lib",
                            f"-L{cls.draco}", "-lsemblante", "-ldraco", "-lstdc++", "-lm")
            compile_program("cc", source, cls.host, cls.folder / f"{name}-host", f"-L{cls.host}/lib", "-lsemblante",
                            f"-Wl,-rpath,{cls.host}/lib")

    def test_golden_streams_and_faces(self):
        here = run(self.folder / "probe-host", FACE, input=golden_streams.lines())
        there = run(EMULATOR, self.folder / "probe", FACE, input=golden_streams.lines())
        self.assertEqual(golden_streams.faults(here), [])
        self.assertEqual(golden_streams.faults(there), [])
        self.assertEqual(len(here.splitlines()), len(there.splitlines()))
        largest = {"positions": 0.0, "normals": 0.0}
        for one, other in zip(here.splitlines(), there.splitlines()):
            word = one.split()[0]
            if word not in largest:
                self.assertEqual(one, other)  # streams, FAPs and bridges: to the last bit
                continue
            (_, a), (_, b) = (next(numbers(line, float.fromhex)) for line in (one, other))
            bound = MAX_NORMAL_DIFFERENCE if word == "normals" else max(map(abs, a)) * MAX_POSITION_DIFFERENCE
            largest[word] = max(largest[word], *(abs(x - y) for x, y in zip(a, b)))
            self.assertLessEqual(max(abs(x - y) for x, y in zip(a, b)), bound, word)
        print(f"largest difference to this machine: {largest}", file=sys.stderr)

    def test_hello_face_static_and_shared(self):
        with tempfile.TemporaryDirectory() as folder:
            out = pathlib.Path(folder, "face.obj")
            run(self.folder / "hello_face-host", FACE, out)
            here = list(numbers(out.read_text(), float))
            run(EMULATOR, self.folder / "hello_face", FACE, out)
            there = list(numbers(out.read_text(), float))
            self.assertEqual(len(here), len(there))
            for (word, a), (other, b) in zip(here, there):
                self.assertEqual(word, other)
                for x, y in zip(a, b):  # printed with six digits
                    self.assertAlmostEqual(x, y, delta=1e-5 * max(1.0, abs(x)))

            shared = pathlib.Path(folder, "shared")
            compile_program("aarch64-linux-gnu-gcc", EXAMPLES / "hello_face.c", self.prefix, shared, f"-L{self.prefix}/lib",
                            "-lsemblante", f"-Wl,-rpath-link,{self.draco}")
            again = pathlib.Path(folder, "again.obj")
            run(EMULATOR, "-L", "/usr/aarch64-linux-gnu", "-E", f"LD_LIBRARY_PATH={self.prefix}/lib:{self.draco}", shared, FACE, again)
            self.assertEqual(again.read_bytes(), out.read_bytes())


@unittest.skipIf(shutil.which("clang") is None, "clang is not installed")
class Phones(unittest.TestCase):
    """Compiled, never run: there is no C library of Android or Apple here. The kernel and the header need none; the C++ goes
    with the headers of GCC's library for aarch64, which Apple's compiler does not take."""

    def test_kernel_and_header_for_android_and_apple(self):
        kernel = [f for f in (TOP / "core/kernel").glob("*.c") if not re.search("avx|wasm", f.name)]
        self.assertGreater(len(kernel), 8)
        for target in ("aarch64-linux-android24", "armv7a-linux-androideabi24", "x86_64-linux-android24", "arm64-apple-ios15",
                       "arm64-apple-macos12", "x86_64-apple-macos12"):
            for file in [*kernel, TOP / "clients/runtime/semblante.h"]:
                run("clang", f"--target={target}", "-ffreestanding", *STRICT[:-1], "-fsyntax-only", "-x", "c", f"-I{TOP}", file)

    def test_all_of_the_library_for_android(self):
        headers = pathlib.Path("/usr/aarch64-linux-gnu/include")
        library = max(headers.glob("c++/*"), default=None)
        if library is None:
            self.skipTest("g++-aarch64-linux-gnu is not installed")
        unities = [f for f in (BUILD / "aarch64/runtime").glob("**/*_sdk.dir/Unity/*.cxx") if "draco" not in str(f)]
        self.assertGreater(len(unities), 6)
        for unity in unities:
            run("clang++", "--target=aarch64-linux-android24", "-fsyntax-only", "-std=c++20", "-fno-rtti", "-Wall", "-Wextra", "-Werror",
                "-nostdinc++", "-nostdlibinc", "-isystem", library, "-isystem", library / "aarch64-linux-gnu", "-isystem", headers,
                "-idirafter", "/usr/include", f"-I{TOP}", unity)


if __name__ == "__main__":
    unittest.main(verbosity=2)
