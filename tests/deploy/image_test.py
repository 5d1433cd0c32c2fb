"""The image: built by buildah, then run as a container runs it: own account, read-only root, nothing else in its file system."""

import json
import os
import re
import subprocess
import unittest

import support
from support import BUILD, TOP, run

LONG = 900
CONTAINERFILE = (TOP / "deploy/image/Containerfile").read_text()
# What a runtime does: a read-only root, /proc, and the two places that can be written.
CONTAINER = """set -e
mount --bind "$1" "$1"
mount -o remount,ro,bind "$1"
mount -t proc proc "$1/proc"
mount -t tmpfs none "$1/dev"
: >"$1/dev/null"
mount --bind /dev/null "$1/dev/null"
mount -t tmpfs -o mode=1777 none "$1/tmp"
mount --bind "$2" "$1/var/lib/semblante"
shift 2
exec chroot "$@"
"""


class Image(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if os.geteuid() != 0:
            raise unittest.SkipTest("buildah and a file system of its own need root here")
        support.need("buildah", "unshare", "chroot")
        if not (TOP / "web/dist/index.html").is_file() or not (BUILD / "sample/sample-head.glb").is_file():
            raise unittest.SkipTest("the studio or the sample head is not built: deploy/run --build-only")
        cls.result = run(TOP / "deploy/image/build", environment=support.clean_environment(SEMBLANTE_BUILD=BUILD), timeout=LONG)
        assert cls.result.returncode == 0, cls.result.stdout + cls.result.stderr
        cls.version = run(BUILD / "bin/semblante", "version").stdout.split()[1]
        environment = support.clean_environment(STORAGE_DRIVER="vfs", BUILDAH_ISOLATION="chroot")
        cls.buildah = staticmethod(lambda *arguments: subprocess.run(["buildah", *arguments], env=environment, capture_output=True, text=True, check=True).stdout)
        cls.container = cls.buildah("from", f"localhost/semblante:{cls.version}").strip()
        cls.root = cls.buildah("mount", cls.container).strip()

    @classmethod
    def tearDownClass(cls):
        if hasattr(cls, "container"):
            cls.buildah("rm", cls.container)

    def in_container(self, folder, *command):
        account = re.search(r"^USER (\S+)$", CONTAINERFILE, re.MULTILINE).group(1)
        data = folder / "data"
        data.mkdir(exist_ok=True)
        os.chown(data, *map(int, account.split(":")))
        return ["unshare", "--mount", "sh", "-c", CONTAINER, "sh", self.root, data, f"--userspec={account}", self.root,
                "/usr/bin/semblante", *command]

    def config(self):
        return json.loads(self.buildah("inspect", "--type", "image", f"localhost/semblante:{self.version}"))["Docker"]["config"]

    def test_configuration(self):
        config = self.config()
        self.assertEqual(config["User"], "10001:10001")
        self.assertEqual(config["Entrypoint"] + config["Cmd"], ["/usr/bin/semblante", "serve"])
        self.assertEqual(config["Healthcheck"]["Test"], ["CMD", "/usr/bin/semblante", "health"])
        self.assertIn("/var/lib/semblante", config["Volumes"])
        self.assertEqual(config["Labels"]["org.opencontainers.image.version"], self.version)

    def test_it_holds_the_server_and_its_libraries(self):
        programs, special = [], []
        for folder, _, names in os.walk(self.root):
            for name in names:
                path = os.path.join(folder, name)
                state = os.lstat(path)
                if state.st_mode & 0o6000:
                    special.append(path)
                if state.st_mode & 0o111 and not name.startswith(("lib", "ld-linux")):
                    programs.append(os.path.relpath(path, self.root))
        self.assertEqual(programs, ["usr/bin/semblante"])
        self.assertEqual(special, [])
        data = os.stat(os.path.join(self.root, "var/lib/semblante"))
        self.assertEqual((data.st_uid, data.st_mode & 0o777), (10001, 0o700))

    def test_size_is_what_the_readme_says(self):
        told = re.search(r"image of (\d+) MB", (TOP / "deploy/README.md").read_text()).group(1)
        size = int(run("du", "-s", "--block-size=1M", self.root).stdout.split()[0])
        self.assertLessEqual(size, int(told))

    def test_it_serves_with_a_read_only_root(self):
        with support.temporary_folder() as folder:
            os.chmod(folder, 0o755)
            with support.Server("/var/lib/semblante", command=self.in_container(folder, "serve")) as server:
                page = support.get(server.url + "/")[2]
                self.assertEqual(page, (TOP / "web/dist/index.html").read_bytes())
                # A job: the worker starts within the container.
                support.eventually(lambda: support.get_json(server.url + "/v1/models/sample")["state"] == "parametrized", "the sample head")
                self.assertEqual(support.get(server.url + "/metrics")[0], 200)
                healthy = run(*self.in_container(folder, "health", "--port", server.port))
                self.assertEqual((healthy.returncode, healthy.stdout), (0, "ready\n"))
                self.assertEqual(server.stop(), 0)
            sick = run(*self.in_container(folder, "health", "--port", server.port))
            self.assertEqual(sick.returncode, 1)
            environment = dict(entry.split("=", 1) for entry in self.config()["Env"] if entry.startswith("SEMBLANTE_"))
            told = run(*self.in_container(folder, "doctor", "--port", "0"), environment=support.clean_environment(**environment))
            self.assertEqual(told.returncode, 0, told.stdout)


class VoiceInTheFileSystem(unittest.TestCase):
    """deploy/image/rootfs --voice: the voice speaks with the libraries and the data of the image alone."""

    def test_it_speaks(self):
        if os.geteuid() != 0:
            self.skipTest("a file system of its own needs root here")
        support.need("unshare", "chroot")
        if not (BUILD / "bin/semblante-voice-espeak").is_file() or not (TOP / "web/dist/index.html").is_file() or not (BUILD / "sample/sample-head.glb").is_file():
            self.skipTest("the voice, the studio or the sample head is not built: deploy/run --build-only")
        with support.temporary_folder() as folder:
            made = run(TOP / "deploy/image/rootfs", "--voice", folder, environment=support.clean_environment(SEMBLANTE_BUILD=BUILD), timeout=LONG)
            self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
            root = folder / "rootfs"
            os.chmod(folder, 0o755)
            data = folder / "data"
            data.mkdir()
            os.chown(data, 10001, 10001)
            (root / "var/lib/semblante").mkdir()
            told = run("unshare", "--mount", "sh", "-c", CONTAINER, "sh", root, data, "--userspec=10001:10001", root, "/usr/bin/semblante", "say", "Olá!",
                       "--language", "pt-BR", "--audio", "/var/lib/semblante/ola.wav")
            self.assertEqual(told.returncode, 0, told.stderr)
            self.assertGreater((data / "ola.wav").stat().st_size, 20_000)
            self.assertIn("GPL-3", (root / "usr/share/doc/semblante-voice-espeak/copyright").read_text())
            self.assertTrue((root / "usr/share/doc/libespeak-ng1/copyright").is_file())


support.main()
