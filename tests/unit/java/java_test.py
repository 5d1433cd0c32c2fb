"""The classes for Java and their native methods are compiled by the JDK and give the golden results. Skipped where there is
no JDK."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "csharp"))

from golden_answers import TOP, VECTORS, GoldenAnswers  # noqa: E402

import support  # noqa: E402


def jdk():
    """The folder of the JDK; None without one that has the headers of JNI."""
    compiler = shutil.which("javac")
    home = pathlib.Path(compiler).resolve().parents[1] if compiler else None
    return home if home and (home / "include/jni.h").is_file() else None


@unittest.skipUnless(jdk() and shutil.which("cc"), "openjdk-17-jdk-headless is not installed")
class Java(GoldenAnswers, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.folder.name)
        sources = sorted((TOP / "clients/java/semblante").glob("*.java")) + [pathlib.Path(__file__).with_name("Answers.java")]
        # 8: what Android understands. -options: a warning that 8 is old.
        subprocess.run([jdk() / "bin/javac", "--release", "8", "-Xlint:all", "-Xlint:-options", "-Werror", "-h", folder / "declared",
                        "-d", folder, *sources], check=True)
        library = pathlib.Path(os.environ["SEMBLANTE_LIBRARY"]).resolve()
        installed = folder / "include/semblante"  # the header's place, as programs name it
        installed.mkdir(parents=True)
        os.symlink(TOP / "clients/runtime/semblante.h", installed / "semblante.h")
        # With the declarations that javac makes of Native.java, so that each definition has the type it is called by.
        subprocess.run(["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-fPIC", "-shared", f"-I{jdk()}/include",
                        f"-I{jdk()}/include/linux", f"-I{folder}/include", f"-I{TOP}", "-include",
                        folder / "declared/semblante_Native.h", TOP / "clients/java/semblante_jni.c", library, "-o",
                        folder / "libsemblante_jni.so"], check=True)
        cls.process = subprocess.Popen([jdk() / "bin/java", "-Xcheck:jni", f"-Djava.library.path={folder}", "-cp", folder, "Answers"],
                                       stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                       env={**os.environ, "LD_LIBRARY_PATH": str(library.parent)})

    @classmethod
    def tearDownClass(cls):
        cls.process.communicate()
        cls.folder.cleanup()

    def test_the_program_of_the_readme_is_compiled_as_it_is_printed(self):
        block, = re.findall(r"^```java\n(.*?)^```", (TOP / "clients/java/README.md").read_text(), re.DOTALL | re.MULTILINE)
        source = pathlib.Path(self.folder.name, "Face.java")
        source.write_text(block)
        subprocess.run([jdk() / "bin/javac", "--release", "8", "-Xlint:all", "-Xlint:-options", "-Werror", "-cp", self.folder.name, "-d",
                        pathlib.Path(self.folder.name, "readme"), source], check=True)

    def test_normals_have_length_one(self):
        self.numbers("head", VECTORS / "face")
        self.assertAlmostEqual(self.numbers("normals")[0], 1, delta=1e-5)

    def test_words_of_files_are_told_in_every_script(self):
        document = pathlib.Path(self.folder.name, "document.json")
        document.write_text('{"format":"semblante.performance","version":1,"name":"a","cues":[],"\U0001f600":1}', encoding="utf-8")
        self.assertIn(" /\U0001f600 ", self.ask("performance", document))

    def test_an_array_that_is_too_short_is_refused(self):
        self.numbers("head", VECTORS / "face")
        self.assertRegex(self.ask("short"), "^error ")

    def test_nothing_is_refused_without_an_end_of_the_process(self):
        self.numbers("head", VECTORS / "face")
        self.assertEqual(self.ask("null"), "12 of 12")


if __name__ == "__main__":
    support.main()
