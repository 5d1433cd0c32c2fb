"""The declarations for C# are compiled by Mono and give the golden results. Skipped where there is no Mono."""

import os
import pathlib
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
