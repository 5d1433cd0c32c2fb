"""README.md's "The command line", run line by line as it is printed, beside a real server.

Usage: readme_test.py; SEMBLANTE_BUILD names the build folder."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

TOP = pathlib.Path(__file__).resolve().parents[3]
BUILD = pathlib.Path(os.environ.get("SEMBLANTE_BUILD", TOP / "build")).resolve()
sys.path.insert(0, str(TOP / "tests/deploy"))

from support import Server, get_json, temporary_folder  # noqa: E402

# Points that are placed in "Your first head"; the others are proposed.
PLACED = 20


def printed_lines():
    section = (TOP / "README.md").read_text(encoding="utf-8").split("## The command line\n")[1].split("\n## ")[0]
    return [line[4:] for line in section.splitlines() if line.startswith("    ")]


def program_of(line):
    return line.split(maxsplit=1)[0]


class CommandLine(unittest.TestCase):
    def setUp(self):
        opened = temporary_folder()
        self.folder = opened.__enter__()
        self.addCleanup(opened.__exit__, None, None, None)
        self.environment = {**os.environ, "PATH": f"{BUILD / 'bin'}:{os.environ['PATH']}", "SEMBLANTE_PORT": "0"}

    def run_line(self, line):
        return subprocess.run(["bash", "-e", "-o", "pipefail", "-c", line], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=600)

    def make(self, *lines):
        for line in lines:
            done = self.run_line(line)
            self.assertEqual(done.returncode, 0, line + done.stderr)

    def make_files(self):
        """The files that the lines name and do not write."""
        self.make("semblante-sample-head . && mv sample-head.glb head.glb && mv sample-head.fps.json head.fps.json",
                  "semblante deform head.glb --feature-points head.fps.json --faps 4=0 --out head.obj",
                  "semblante deform head.obj --feature-points head.fps.json --weights smooth --expression joy --out smile.obj",
                  "cp head.obj other.obj && cp head.fps.json other.fps.json")
        # Of half a second: it is drawn frame by frame, and played in real time.
        hello = {"frames": [{"time": 40 * i, "faps": {"3": 30 * i}} for i in range(12)]}
        (self.folder / "frames.json").write_text(json.dumps(hello))
        self.make("semblante convert frames.json --out-format performance --out hello.json")
        for name in ("joy.fap", "take.csv", "recorded.json"):
            self.make(f"semblante convert hello.json --rate 25 --out {name}")
        points = json.loads((self.folder / "head.fps.json").read_text())["points"]
        (self.folder / "twenty.fps.json").write_text(json.dumps({"points": dict(list(points.items())[:: len(points) // PLACED])}))
        cues = [{"start": 0.0, "end": 0.3, "value": "X"}, {"start": 0.3, "end": 0.6, "value": "D"}]
        (self.folder / "visemes.json").write_text(json.dumps({"mouthCues": cues}))
        self.make("semblante say a --language en --voice-program " + str(TOP / "server/voice/examples/beeps.py") + " --audio take.wav")

    def test_every_line_does_what_it_is_printed_for(self):
        speaks = (BUILD / "bin/semblante-voice-espeak").exists()
        lines = [line for line in printed_lines() if "faces.example" not in line]
        self.assertGreater(len(lines), 20)
        lines = [line for line in lines if shutil.which(program_of(line), path=self.environment["PATH"])]
        if not speaks:
            lines = [line for line in lines if not line.startswith('semblante say "')]
        self.make_files()
        with Server(self.folder / "data") as server:
            self.environment["SEMBLANTE_SERVER"] = server.url
            for line in lines:
                done = self.run_line(line)
                self.assertEqual(done.returncode, 0, f"{line}\n{done.stdout}{done.stderr}")
                written = re.search(r"--out (\S+)", line)
                if written:
                    path = self.folder / written.group(1)
                    self.assertTrue(any(path.iterdir()) if path.is_dir() else path.stat().st_size > 0, line)
            self.assertGreater(get_json(f"{server.url}/v1/streams/hello")["sequence"], 0)
        self.assertTrue((self.folder / "backup-today").is_dir())


if __name__ == "__main__":
    unittest.main(verbosity=2)
