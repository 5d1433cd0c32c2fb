"""The viewer for Android: built, signed, and checked as far as that goes without a device. The half that draws nothing is run by an
emulator of aarch64 against a server of this machine.

Run by `tests/run --android`; needs build/bin/semblante and build/sample."""

import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request
import zipfile

TOP = pathlib.Path(__file__).resolve().parents[3]
BUILD = pathlib.Path(os.environ.get("SEMBLANTE_BUILD", TOP / "build")).resolve()
ANDROID = TOP / "clients/native/android"
EMULATOR = shutil.which("qemu-aarch64-static") or shutil.which("qemu-aarch64")
LIBRARY = "lib/arm64-v8a/libsemblante_viewer.so"
PAGE = 16384  # bytes of the largest page of Android's arm64 systems

os.environ.setdefault("SEMBLANTE_LIBRARY", str(BUILD / "lib/libsemblante.so"))
sys.path.insert(0, str(TOP / "clients/python"))


def run(*arguments, **options):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, timeout=1800, **options)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(map(str, arguments))}\n{done.stdout}{done.stderr}")
    return done.stdout


def names_of_android():
    """The names in clients/native/android/system, by library."""
    return {file.stem: {line.split()[0] for line in file.read_text().splitlines() if line.strip() and not line.startswith("#")}
            for file in (ANDROID / "system").glob("*.txt")}


class Android(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = BUILD / "android"
        built = subprocess.run([str(ANDROID / "build"), str(cls.folder)], capture_output=True, text=True, timeout=3000)
        if "not installed:" in built.stderr:
            raise unittest.SkipTest(built.stderr.strip())
        if built.returncode != 0:
            raise AssertionError(built.stdout[-4000:] + built.stderr[-4000:])
        cls.apk = cls.folder / "semblante-viewer.apk"
        cls.library = cls.folder / "stripped.so"
        with zipfile.ZipFile(cls.apk) as apk:
            cls.library.write_bytes(apk.read(LIBRARY))

    def test_signature(self):
        said = run("apksigner", "verify", "--verbose", "--min-sdk-version", "29", self.apk)
        self.assertRegex(said, r"Verified using v3 scheme .*: true")

    def test_a_changed_package_is_not_verified(self):
        with tempfile.TemporaryDirectory() as folder:
            other = pathlib.Path(folder, "other.apk")
            content = bytearray(self.apk.read_bytes())
            with zipfile.ZipFile(self.apk) as apk:
                content[apk.getinfo(LIBRARY).header_offset + 100_000] ^= 1
            other.write_bytes(content)
            with self.assertRaises(AssertionError):
                run("apksigner", "verify", "--min-sdk-version", "29", other)

    def test_manifest(self):
        said = run("aapt", "dump", "badging", self.apk)
        for fact in ("package: name='org.semblante.viewer'", "sdkVersion:'29'", "uses-gl-es: '0x30000'",
                     "uses-permission: name='android.permission.INTERNET'", "launchable-activity: name='android.app.NativeActivity'",
                     "native-code: 'arm64-v8a'"):
            self.assertIn(fact, said)
        project = re.search(r"project\(semblante VERSION (\S+)", (TOP / "CMakeLists.txt").read_text())[1]
        self.assertIn(f"versionName='{project}'", said)
        tree = run("aapt", "dump", "xmltree", self.apk, "AndroidManifest.xml")
        self.assertIn('"semblante_viewer"', tree)  # the library that the system looks for: lib...so
        self.assertRegex(tree, r"hasCode.*=\(type 0x12\)0x0")

    def test_library_lies_at_a_page(self):
        self.assertEqual(run("zipalign", "-c", PAGE, self.apk), "")
        with zipfile.ZipFile(self.apk) as apk, open(self.apk, "rb") as file:
            info = apk.getinfo(LIBRARY)
            self.assertEqual(info.compress_type, zipfile.ZIP_STORED)
            file.seek(info.header_offset)
            head = file.read(30)
            start = info.header_offset + 30 + int.from_bytes(head[26:28], "little") + int.from_bytes(head[28:30], "little")
            self.assertEqual(start % PAGE, 0)
        segments = [line.split() for line in run("readelf", "-lW", self.library).splitlines() if line.split()[:1] == ["LOAD"]]
        self.assertGreater(len(segments), 1)
        for segment in segments:
            self.assertEqual(int(segment[-1], 16) % PAGE, 0, segment)

    def test_names_are_those_of_android(self):
        """Each library is Android's, each undefined name is listed, and each listed name is used: an unknown name would end the app
        when it starts."""
        dynamic = run("readelf", "-dW", self.library)
        lists = names_of_android()
        self.assertEqual(sorted(re.findall(r"NEEDED.*\[(.*)\]", dynamic)), sorted(f"{name}.so" for name in lists))
        self.assertNotIn("TEXTREL", dynamic)
        self.assertNotIn("VERNEED", dynamic)  # versions of glibc
        undefined, defined = set(), set()
        for line in run("aarch64-linux-gnu-nm", "-D", self.library).splitlines():
            *_, kind, name = line.split()
            (undefined if kind in "Uw" else defined).add((name, kind))
        weak = {name for name, kind in undefined if kind == "w"}
        strong = {name for name, kind in undefined if kind == "U"}
        known = set().union(*lists.values())
        self.assertEqual(sum(map(len, lists.values())), len(known), "a name of two libraries")
        self.assertEqual(strong - known, set())
        self.assertEqual(known - strong - weak, set(), "listed, and not used")
        self.assertEqual({name for name, _ in defined}, {"ANativeActivity_onCreate"})

    def test_the_half_without_a_screen_runs(self):
        if EMULATOR is None:
            self.skipTest("qemu-user-static is not installed")
        import semblante

        with tempfile.TemporaryDirectory() as folder:
            server = subprocess.Popen(
                [BUILD / "bin/semblante", "serve", "--port", "0", "--data", folder, "--sample",
                 next((BUILD / "sample").glob("*.glb")), "--log-level", "warning"], stdout=subprocess.PIPE, text=True)
            try:
                url = re.search(r"http://\S+", server.stdout.readline())[0].rstrip("/")

                def ask(path, body=None):
                    request = urllib.request.Request(url + path, data=None if body is None else json.dumps(body).encode(),
                                                     headers={"Content-Type": "application/json"})
                    with urllib.request.urlopen(request, timeout=60) as answer:
                        return json.loads(answer.read() or "null")

                while ask("/v1/models/sample")["state"] != "parametrized":
                    time.sleep(0.2)
                ask("/v1/streams", {"name": "phone", "model": "sample", "batch_interval": 0})
                faps = {3: 300, 4: -100, 51: 80}
                ask("/v1/streams/phone/frames", {"frames": [{"time": 0, "faps": {str(k): v for k, v in faps.items()}}]})
                said = run(EMULATOR, self.folder / "build/bin/semblante-android-check", url + "/view/phone", "1")
                head = semblante.fetch_head(url, "sample")
                head.set_frame(semblante.frame(faps))
                moved = sum(math.dist(a, b) for a, b in zip(head.positions().tolist(), head.neutral.tolist())) / len(head.neutral)
                vertices, triangles = map(int, re.search(r"vertices (\d+) triangles (\d+)", said).groups())
                self.assertEqual((vertices, triangles), (len(head.neutral), len(head.triangles)))
                self.assertGreater(moved, 0)
                self.assertAlmostEqual(float(re.findall(r"moved (\S+)", said)[-1]), moved, delta=1e-5 * moved)
            finally:
                server.terminate()
                server.wait(timeout=60)
                server.stdout.close()


if __name__ == "__main__":
    unittest.main(verbosity=2)
