"""The declarations for C# are compiled by Mono and give the golden results. Skipped where there is no Mono."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from golden_answers import TOP, GoldenAnswers

import support


@unittest.skipUnless(shutil.which("mcs") and shutil.which("mono"), "mono-mcs and mono-runtime are not installed")
class CSharp(GoldenAnswers, unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        program = pathlib.Path(cls.folder.name, "answers.exe")
        sources = sorted((TOP / "clients/csharp").glob("*.cs")) + [pathlib.Path(__file__).with_name("Answers.cs")]
        subprocess.run(["mcs", "-unsafe", "-warnaserror", f"-out:{program}", *sources], check=True)
        library = pathlib.Path(os.environ["SEMBLANTE_LIBRARY"])
        os.symlink(library.resolve(), pathlib.Path(cls.folder.name, "libsemblante.so"))
        cls.process = subprocess.Popen(["mono", program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                       env={**os.environ, "LD_LIBRARY_PATH": cls.folder.name})

    @classmethod
    def tearDownClass(cls):
        cls.process.communicate()
        cls.folder.cleanup()

    def test_the_behaviour_of_the_readme_is_compiled(self):
        """With as much of Unity as it uses, and the two methods that it leaves to the reader."""
        block, = re.findall(r"^```csharp\n(.*?)^```", (TOP / "clients/csharp/README.md").read_text(), re.DOTALL | re.MULTILINE)
        source = pathlib.Path(self.folder.name, "Face.cs")
        source.write_text("""using System.Collections.Concurrent;
class MonoBehaviour {}
class Mesh { public Vector3[] vertices; }
struct Vector3 { public Vector3(float x, float y, float z) {} }
static class Time { public static double realtimeSinceStartupAsDouble; public static float deltaTime; }
""" + block.rstrip().removesuffix("}").replace("public sealed", "sealed") +
                          "void Handle(Semblante.StreamEvent happened) {} void Send(byte[] message) {} }\n")
        subprocess.run(["mcs", "-unsafe", "-nowarn:0649,0414", "-warnaserror", "-target:library", f"-out:{source}.dll", source,
                        *(TOP / "clients/csharp").glob("*.cs")], check=True)

    def test_structs_have_the_size_that_they_have_in_python(self):
        from semblante import _library
        for name, struct in {"Frame": _library.Frame, "TimedFrame": _library.TimedFrame, "Native+Error": _library.Error,
                             "Native+Package": _library.Package, "Native+HeadOptions": _library.HeadOptions,
                             "Native+StreamOptions": _library.StreamOptions, "Native+Event": _library.Event,
                             "Native+PlayerOptions": _library.PlayerOptions, "Native+ListenerOptions": _library.ListenerOptions,
                             "Native+Heard": _library.Heard}.items():
            self.assertEqual(self.ask("size", f"Semblante.{name}"), str(_library.ctypes.sizeof(struct)), name)


if __name__ == "__main__":
    support.main()
