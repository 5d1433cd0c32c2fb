"""libsemblante as others get it: configured alone, installed, moved, and used from projects outside the tree."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parents[3]
BUILD = pathlib.Path(os.environ.get("SEMBLANTE_BUILD", TOP / "build")).resolve()
HERE = TOP / "tests/integration/sdk"
EXAMPLES = TOP / "clients/runtime/examples"
FACE = TOP / "protocol/vectors/face"
COLORED = TOP / "protocol/vectors/face_colored"
STRICT = ["-Wall", "-Wextra", "-Werror", "-pedantic"]
# What the whole tree wants; the library alone may ask for none of it.
FOREIGN = ("Boost", "CLI11", "Eigen3", "GTest", "OpenMesh", "OpenSSL", "PkgConfig", "ZLIB", "meshoptimizer", "nlohmann_json")
# Stripped, on 64-bit x86: about 486,000 with Draco's library beside it.
MAX_SHARED_BYTES = 490_000

# What libsemblante.a wants of a C library, as clients/runtime/README.md states it: no file, socket, thread, clock or locale.
STATED_FUNCTIONS = set(re.search(r"Of the C library it uses ([^:]*):", (TOP / "clients/runtime/README.md").read_text())[1]
                       .replace("`", "").replace(" and", ",").replace("\n", " ").replace(",", " ").split())

sys.path.insert(0, str(TOP / "tests/deploy"))
import golden_streams  # noqa: E402
from support import Server, eventually, get  # noqa: E402


def run(*arguments, **options):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, timeout=900, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}")
    return done.stdout


def stripped_size(library):
    with tempfile.TemporaryDirectory() as folder:
        run("strip", "-o", f"{folder}/stripped", library)
        return os.path.getsize(f"{folder}/stripped")


class Installed(unittest.TestCase):
    """The component `runtime` of the normal build, moved after the installation."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="semblante-sdk-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        run("cmake", "--install", BUILD, "--component", "runtime", "--prefix", cls.folder / "first")
        cls.prefix = cls.folder / "moved"
        (cls.folder / "first").rename(cls.prefix)
        cls.library_folder = next(cls.prefix.glob("**/libsemblante.so")).parent
        cls.packages = {**os.environ, "PKG_CONFIG_PATH": str(cls.library_folder / "pkgconfig")}
        # The sources, where no header of the tree can be found by chance.
        shutil.copytree(HERE / "consumer", cls.folder / "consumer")
        for source in [*EXAMPLES.iterdir(), HERE / "clash.cpp"]:
            shutil.copy(source, cls.folder / "consumer")
        for name in ("hello_face", "follow"):
            shutil.copy(EXAMPLES / f"{name}.c", cls.folder / f"consumer/{name}_plus.cpp")

    def expect_a_face(self, program, environment=None):
        out = self.folder / "face.obj"
        out.unlink(missing_ok=True)
        self.assertEqual(run(program, FACE, out, env=environment), "196 vertices\n")
        lines = out.read_text().splitlines()
        self.assertEqual(sum(line.startswith("v ") for line in lines), 196)
        corners = [int(n) for line in lines if line.startswith("f ") for n in line.split()[1:]]
        self.assertGreater(len(corners), 0)
        self.assertTrue(all(1 <= n <= 196 for n in corners))
        return out.read_bytes()

    def test_the_colors_of_a_scan_are_written_by_the_examples(self):
        program = self.folder / "hello-colored"
        run("cc", "-std=c99", *STRICT, EXAMPLES / "hello_face.c", *run("pkg-config", "--cflags", "--libs", "semblante",
            env=self.packages).split(), f"-Wl,-rpath,{self.library_folder}", "-o", program)
        package = {**os.environ, "PYTHONPATH": str(TOP / "clients/python"), "PYTHONDONTWRITEBYTECODE": "1",
                   "SEMBLANTE_LIBRARY": str(self.library_folder / "libsemblante.so")}
        python = [sys.executable, TOP / "clients/python/examples/hello_face.py"]
        written = []
        for name, command, environment in (("c", [program], None), ("python", python, package)):
            out = self.folder / f"colored-{name}.obj"
            run(*command, COLORED, out, env=environment)
            places = [line.split()[1:] for line in out.read_text().splitlines() if line.startswith("v ")]
            written.append([place[3:] for place in places])
        self.assertEqual(written[0], written[1])
        channels = [float(channel) for color in written[0] for channel in color]
        self.assertEqual((len(channels), min(channels), max(channels)), (3 * 196, 0, 1))

    def test_the_files_are_where_they_are_looked_for(self):
        files = {str(path.relative_to(self.prefix)) for path in self.prefix.rglob("*") if path.is_file()}
        library = str(self.library_folder.relative_to(self.prefix))
        for expected in ("include/semblante/semblante.h", f"{library}/libsemblante.so.0", f"{library}/libsemblante.a",
                         f"{library}/pkgconfig/semblante.pc", f"{library}/cmake/semblante/semblanteConfig.cmake",
                         f"{library}/cmake/semblante/semblanteConfigVersion.cmake"):
            self.assertIn(expected, files)
        for path in self.prefix.rglob("*"):
            if path.suffix in (".cmake", ".pc", ".h"):
                text = path.read_text()
                for place in (TOP, BUILD, self.folder):
                    self.assertNotIn(str(place), text, path)

    def test_the_header_stands_alone(self):
        header = self.prefix / "include/semblante/semblante.h"
        self.assertEqual([line for line in header.read_text().splitlines() if line.startswith("#include \"")], [])
        for compiler, language, standard in (("cc", "c", "c99"), ("cc", "c", "c11"), ("c++", "c++", "c++11"), ("clang", "c", "c99"),
                                             ("clang++", "c++", "c++20")):
            if shutil.which(compiler):
                run(compiler, "-x", language, f"-std={standard}", *STRICT, "-fsyntax-only", header)

    def test_cmake_finds_it_for_c_and_for_cpp_shared_and_static(self):
        faces = set()
        for languages, programs in (("C", "hello_face.c;follow.c"), ("CXX", "hello_face_plus.cpp;follow_plus.cpp;clash.cpp")):
            build = self.folder / f"build-{languages}"
            run("cmake", "-S", self.folder / "consumer", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
                f"-DLANGUAGES={languages}", f"-DPROGRAMS={programs}")
            run("cmake", "--build", build)
            for kind in ("semblante", "semblante_static"):
                name = "hello_face" if languages == "C" else "hello_face_plus"
                faces.add(self.expect_a_face(build / f"{name}_{kind}"))
                if languages == "CXX":
                    self.assertEqual(run(build / f"clash_{kind}"), "4 7\n")
        self.assertEqual(len(faces), 1)

    def test_the_integrations_of_the_readme_and_of_the_header_are_compiled_as_they_are_printed(self):
        def indented(text):
            return "".join(line[4:] + "\n" for line in text.splitlines() if line.startswith("    "))

        readme = indented((TOP / "clients/README.md").read_text())
        header = "".join(line[5:] for line in re.findall(r"^ \*   .*\n", (TOP / "clients/runtime/semblante.h").read_text().split("Rules")[0],
                                                         re.MULTILINE))
        given = """const float* positions, uint32_t n, const uint8_t* mesh, size_t mesh_size, const uint8_t* weights, size_t weights_size,
const char* rig, size_t rig_size, float* out, double now, double elapsed"""
        for name, text in (("readme", readme), ("header", header)):
            self.assertIn("semblante_head_create", text)
            text = (f"#include <stdio.h>\n#include <semblante/semblante.h>\nint integrate({given});\n"
                    f"int integrate({given}) {{\n{text}return 0; }}\n")
            for ending, compiler in ((".c", ["cc", "-std=c99"]), (".cpp", ["c++", "-std=c++11", "-Wno-missing-field-initializers"])):
                source = self.folder / (name + ending)
                source.write_text(text)
                run(compiler[0], *STRICT, *compiler[1:], *run("pkg-config", "--cflags", "semblante", env=self.packages).split(),
                    "-Wno-unused-parameter", "-c", source, "-o", self.folder / "integration.o")

    def test_another_minor_version_is_refused(self):
        done = subprocess.run(["cmake", "-S", self.folder / "consumer", "-B", self.folder / "version", "-DLANGUAGES=C",
                               "-DPROGRAMS=hello_face.c", "-DVERSION=0.0", f"-DCMAKE_PREFIX_PATH={self.prefix}"],
                              capture_output=True, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("version: 0.2.0", done.stderr)

    def test_pkg_config_finds_it_for_c_and_for_cpp_shared_and_static(self):
        faces, loaded = set(), {**os.environ, "LD_LIBRARY_PATH": str(self.library_folder)}
        flags = run("pkg-config", "--cflags", "--libs", "semblante", env=self.packages).split()
        static = ["-static", *run("pkg-config", "--static", "--cflags", "--libs", "semblante", env=self.packages).split()]
        for source, compiler in (("hello_face.c", ["cc", "-std=c99"]), ("hello_face_plus.cpp", ["c++", "-std=c++11"])):
            for name, libraries in (("shared", flags), ("static", static)):
                program = self.folder / f"pkg-{name}"
                run(*compiler, *STRICT, self.folder / "consumer" / source, *libraries, "-o", program)
                faces.add(self.expect_a_face(program, loaded))
        self.assertEqual(len(faces), 1)
        self.assertIn("not a dynamic executable",
                      subprocess.run(["ldd", self.folder / "pkg-static"], capture_output=True, text=True, check=False).stderr)

    def test_nothing_but_the_header_s_names_is_global(self):
        listed = set(re.findall(r"(semblante_\w+);", (TOP / "clients/runtime/exports.map").read_text()))
        for kind, options in (("libsemblante.so", "-D"), ("libsemblante.a", "-g")):
            lines = run("nm", options, "--defined-only", self.library_folder / kind).splitlines()
            self.assertEqual({line.split()[-1] for line in lines if len(line.split()) == 3}, listed, kind)
        dynamic = run("readelf", "-d", self.library_folder / "libsemblante.so")
        self.assertIn("soname: [libsemblante.so.0]", dynamic)
        needed = set(re.findall(r"NEEDED.*\[(\w+)", dynamic))
        self.assertLessEqual(needed, {"libc", "libm", "libgcc_s", "libstdc", "libdraco", "ld"})

    @unittest.skipUnless(os.uname().machine == "x86_64", "the bound is that of 64-bit x86")
    def test_the_shared_library_is_small(self):
        self.assertLess(stripped_size(self.library_folder / "libsemblante.so"), MAX_SHARED_BYTES)

    def test_golden_streams_through_the_header_alone(self):
        program = self.folder / "probe"
        run("cc", "-std=c99", *STRICT, f"-I{EXAMPLES}", HERE / "probe.c", *run("pkg-config", "--cflags", "--libs", "semblante",
            env=self.packages).split(), f"-Wl,-rpath,{self.library_folder}", "-o", program)
        self.assertEqual(golden_streams.faults(run(program, FACE, input=golden_streams.lines())), [])

    def test_only_stated_functions_of_the_system_are_used(self):
        undefined = run("nm", "-uC", self.library_folder / "libsemblante.a")
        names = {line.split()[1] for line in undefined.splitlines() if len(line.split()) == 2 and line.split()[0] in "Uw"}
        foreign = {n.split("@")[0] for n in names if not re.match(r"std::|operator|draco::|vtable|__|_Unwind|_GLOBAL_OFFSET", n)}
        self.assertLessEqual(foreign, STATED_FUNCTIONS)

    def test_follow_shows_the_jaw_of_a_real_server(self):
        program = self.folder / "follow"
        run("cc", "-std=c99", *STRICT, EXAMPLES / "follow.c", *run("pkg-config", "--cflags", "--libs", "semblante",
            env=self.packages).split(), f"-Wl,-rpath,{self.library_folder}", "-o", program)
        with Server(self.folder / "data") as server:
            status, _, body = get(f"{server.url}/v1/streams", data=b'{"name":"jaw"}', headers={"content-type": "application/json"})
            self.assertEqual(status, 201, body)
            process = subprocess.Popen([program, "127.0.0.1", str(server.port), "jaw", FACE, "3"], stdout=subprocess.PIPE, text=True)
            try:
                fap = [0]

                def is_over():
                    fap[0] += 10  # each frame another face, since a face that does not change is not shown again
                    frames = b'{"frames":[{"faps":{"3":%d}}]}' % fap[0]
                    self.assertLess(get(f"{server.url}/v1/streams/jaw/frames", data=frames,
                                        headers={"content-type": "application/json"})[0], 300)
                    return process.poll() is not None

                eventually(is_over, "three faces")
                lines = process.stdout.read().splitlines()
            finally:
                process.kill()
                process.wait()
                process.stdout.close()
        self.assertEqual(process.returncode, 0)
        self.assertEqual(len(lines), 3)
        for line in lines:
            self.assertRegex(line, r"^ *-?[\d.]+ ms  jaw +[\d.]+$")
        jaws = [float(line.split()[-1]) for line in lines]
        self.assertGreater(max(jaws), 0)

    def test_follow_of_a_stream_that_is_not_there_ends_with_the_servers_answer(self):
        program = self.folder / "follow-nothing"
        run("cc", "-std=c99", *STRICT, EXAMPLES / "follow.c", *run("pkg-config", "--cflags", "--libs", "semblante",
            env=self.packages).split(), f"-Wl,-rpath,{self.library_folder}", "-o", program)
        with Server(self.folder / "data-nothing") as server:
            done = subprocess.run([program, "127.0.0.1", str(server.port), "nothing", FACE], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "the server does not open the stream: HTTP/1.1 404 Not Found\n")

    def test_files_that_are_no_package_end_in_words(self):
        for text, name in (("", "empty"), ("x" * 100, "rubbish")):
            folder = self.folder / name
            folder.mkdir()
            for part in ("mesh.drc", "weights", "rig.json"):
                (folder / part).write_text(text)
            program = self.folder / f"hello-{name}"
            run("cc", EXAMPLES / "hello_face.c", *run("pkg-config", "--cflags", "--libs", "semblante", env=self.packages).split(),
                f"-Wl,-rpath,{self.library_folder}", "-o", program)
            done = subprocess.run([program, folder, self.folder / "out.obj"], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertNotEqual(done.stderr, "")


class Alone(unittest.TestCase):
    """A configuration of the library alone. Its folder stays, so that only the first run compiles everything."""

    @classmethod
    def setUpClass(cls):
        cls.build = BUILD / "sdk-alone"
        without = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in FOREIGN]
        cls.words = run("cmake", "-S", TOP, "-B", cls.build, "-G", "Ninja", "-DSEMBLANTE_RUNTIME_ONLY=ON", "-DSEMBLANTE_DRACO=OFF",
                        "-DCMAKE_INSTALL_LIBDIR=lib/here", *without)
        run("cmake", "--build", cls.build)
        cls.prefix = cls.build / "prefix"
        shutil.rmtree(cls.prefix, ignore_errors=True)
        run("cmake", "--install", cls.build, "--prefix", cls.prefix)

    def test_without_draco_it_asks_for_the_decoded_mesh(self):
        library = self.prefix / "lib/here"
        flags = run("pkg-config", "--cflags", "--libs", "semblante", env={**os.environ, "PKG_CONFIG_PATH": str(library / "pkgconfig")})
        run("cc", EXAMPLES / "hello_face.c", *flags.split(), f"-Wl,-rpath,{library}", "-o", self.build / "hello_face")
        done = subprocess.run([self.build / "hello_face", FACE, self.build / "out.obj"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("no Draco decoder", done.stderr)
        self.assertNotIn("draco", run("readelf", "-d", library / "libsemblante.so") + flags)

    def test_programs_of_the_tree_are_not_built(self):
        self.assertFalse((self.build / "bin").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
