"""The declarations for C# are compiled by Mono and give the golden results. Skipped where there is no Mono."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(TOP / "clients/python"), str(TOP / "tests/deploy")]

import support  # noqa: E402

VECTORS = TOP / "protocol/vectors"


@unittest.skipUnless(shutil.which("mcs") and shutil.which("mono"), "mono-mcs and mono-runtime are not installed")
class CSharp(unittest.TestCase):
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

    def ask(self, *words):
        print(*words, file=self.process.stdin, flush=True)
        return self.process.stdout.readline().rstrip("\n")

    def numbers(self, *words):
        answer = self.ask(*words)
        self.assertFalse(answer.startswith("error"), answer)
        return [float(word) for word in answer.split()]

    def test_structs_have_the_size_that_they_have_in_python(self):
        from semblante import _library
        for name, struct in {"Frame": _library.Frame, "TimedFrame": _library.TimedFrame, "Native+Error": _library.Error,
                             "Native+Package": _library.Package, "Native+HeadOptions": _library.HeadOptions,
                             "Native+StreamOptions": _library.StreamOptions, "Native+Event": _library.Event,
                             "Native+PlayerOptions": _library.PlayerOptions}.items():
            self.assertEqual(self.ask("size", f"Semblante.{name}"), str(_library.ctypes.sizeof(struct)), name)

    def test_performances_give_the_golden_frames(self):
        self.numbers("performance", VECTORS / "performance/corners.json")
        for golden in json.loads((VECTORS / "performance/corners.frames.json").read_text())["frames"]:
            numbers = self.numbers("at", golden["time"])
            for n in range(3, 69):
                self.assertAlmostEqual(numbers[4 + n], golden["faps"].get(str(n), 0), delta=0.01)

    def test_arkit_gives_the_golden_faps(self):
        cases = json.loads((VECTORS / "bridges/bridges.json").read_text())["in"]
        for case in cases:
            numbers = self.numbers("arkit", *(w for pair in case["coefficients"].items() for w in pair))
            for n, value in case["faps"].items():
                self.assertAlmostEqual(numbers[4 + int(n)], value, delta=max(0.02, 1e-5 * abs(value)))

    def test_a_head_moves_as_it_does_in_python(self):
        import semblante
        head = semblante.Head(*((VECTORS / "face" / name).read_bytes() for name in ("mesh.drc", "weights", "rig.json")))
        self.assertEqual(self.numbers("head", VECTORS / "face"), [head.vertex_count, 3 * len(head.triangles.tolist())])
        head.set_frame(semblante.frame({3: 200}))
        moved = [x for row in head.positions().tolist() for x in row]
        self.assertEqual(self.numbers("fap", 3, 200), moved)

    def test_a_stream_is_read_and_played(self):
        self.numbers("head", VECTORS / "face")
        self.assertTrue(self.ask("stream").startswith("0101"))  # hello, version 1
        messages = json.loads((VECTORS / "v1/messages.json").read_text())["messages"]
        header = next(m["binary"] for m in messages if m["json"]["type"] == "header")
        self.assertIn("Header", self.ask("receive", 10, header))
        stream = json.loads((VECTORS / "v1/packed.json").read_text())["streams"][-1]["messages"]
        for message in stream:
            self.assertIn("Keyframe" if message["json"]["type"] == "keyframe" else "Frames", self.ask("receive", 20, message["binary"]))
        self.assertTrue(self.ask("play", 30, 16).startswith("True True "))

    def test_errors_are_exceptions_with_words(self):
        self.assertRegex(self.ask("performance", VECTORS / "face/weights"), "^error malformed ")
        self.assertEqual(self.ask("wait"), "done")  # objects that failed to be made are collected


if __name__ == "__main__":
    support.main()
