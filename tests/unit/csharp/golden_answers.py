"""What a program that answers by declarations of libsemblante must say: the golden results. For C# and Java."""

import json
import pathlib
import sys

TOP = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(TOP / "clients/python"), str(TOP / "tests/deploy")]

VECTORS = TOP / "protocol/vectors"


class GoldenAnswers:
    """`process`: the program, which answers each line of its input by one line."""

    process = None

    def ask(self, *words):
        print(*words, file=self.process.stdin, flush=True)
        return self.process.stdout.readline().rstrip("\n")

    def numbers(self, *words):
        answer = self.ask(*words)
        self.assertFalse(answer.startswith("error"), answer)
        return [float(word) for word in answer.split()]

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

    def test_a_listener_hears_what_it_does_in_python(self):
        import semblante
        samples = [0.25 if i % 100 < 5 else 0.0 for i in range(8000)]
        mouth = semblante.from_oculus(list(semblante.Listener(16000).push(samples)[-1].weights))
        self.assertEqual(self.numbers("listen", 8000)[:3], [mouth.viseme1, mouth.viseme2, mouth.viseme_blend])
        self.assertEqual(self.ask("listen", 100), "nothing")

    def test_a_head_moves_as_it_does_in_python(self):
        import semblante
        package = [(VECTORS / "face_colored" / name).read_bytes() for name in ("mesh.drc", "weights", "rig.json")]
        moved = []
        for choice in ([], ["jaw_takes_lip"]):
            head = semblante.Head(*package, jaw_takes_lip=bool(choice))
            self.assertEqual(self.numbers("head", VECTORS / "face_colored", *choice), [head.vertex_count, 3 * len(head.triangles.tolist())])
            head.set_frame(semblante.frame({3: 200}))
            moved.append([x for row in head.positions().tolist() for x in row])
            self.assertEqual(self.numbers("fap", 3, 200), moved[-1])
        self.assertTrue(moved[0] != moved[1])

    def test_the_colors_of_a_head_are_those_of_python(self):
        import semblante
        self.numbers("head", VECTORS / "face")
        self.assertEqual(self.ask("colors"), "none")
        folder = VECTORS / "face_colored"
        self.numbers("head", folder)
        head = semblante.Head(*((folder / name).read_bytes() for name in ("mesh.drc", "weights", "rig.json")))
        self.assertEqual(self.numbers("colors"), [channel for color in head.colors.tolist() for channel in color])

    def test_a_stream_is_read_and_played(self):
        self.numbers("head", VECTORS / "face")
        self.assertTrue(self.ask("stream").startswith("0101"))  # hello, version 1
        messages = json.loads((VECTORS / "v1/messages.json").read_text())["messages"]
        header = next(m["binary"] for m in messages if m["json"]["type"] == "header")
        self.assertIn("Header", self.ask("receive", 10, header))
        text = "0b03e80c02656e05416d20706504ab1119b3"
        self.assertIn("Text 3|en|Am pe|360|0,180 ", self.ask("receive", 15, text))
        stream = json.loads((VECTORS / "v1/packed.json").read_text())["streams"][-1]["messages"]
        for message in stream:
            self.assertIn("Keyframe" if message["json"]["type"] == "keyframe" else "Frames", self.ask("receive", 20, message["binary"]))
        self.assertTrue(self.ask("play", 30, 16).startswith("True True "))

    def test_errors_are_exceptions_with_words(self):
        self.assertRegex(self.ask("performance", VECTORS / "face/weights"), "^error malformed ")
        self.assertEqual(self.ask("wait"), "done")  # objects that failed to be made are collected
