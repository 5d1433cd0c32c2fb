"""The Debian package in a bare Debian 12: built, installed, started, removed; nothing stays behind but data.

Not among the tests of ctest: it takes minutes and a mirror. As root, with debootstrap, after deploy/run --build-only:

    python3 tests/deploy/package_test.py

SEMBLANTE_BARE_SYSTEM: a folder made by `debootstrap --variant=minbase bookworm FOLDER`, which is copied instead of made again."""

import contextlib
import json
import os
import pathlib
import subprocess
import unittest

import support
from support import BUILD, TOP

LONG = 1800
CONFIG = "/etc/semblante/semblante.toml"
DATA = "/var/lib/semblante"


class BareSystem:
    def __init__(self, folder):
        self.root = folder / "system"
        ready = os.environ.get("SEMBLANTE_BARE_SYSTEM")
        command = ["cp", "-a", ready, self.root] if ready else ["debootstrap", "--variant=minbase", "bookworm", self.root]
        result = support.run(*command, timeout=LONG)
        assert result.returncode == 0, result.stdout + result.stderr
        (self.root / "etc/resolv.conf").write_bytes(pathlib.Path("/etc/resolv.conf").read_bytes())

    def command(self, *arguments, account=None):
        return ["chroot", self.root, *(["setpriv", "--reuid", account, "--regid", account, "--clear-groups"] if account else []), *arguments]

    def run(self, *arguments, account=None, check=True):
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "DEBIAN_FRONTEND": "noninteractive", "LC_ALL": "C"}
        result = support.run(*self.command(*arguments, account=account), environment=environment, timeout=LONG)
        if check and result.returncode != 0:
            raise AssertionError(f"{arguments}: {result.stdout}{result.stderr}")
        return result.stdout

    def files(self):
        """Everything that is named after us, from the root."""
        found = self.run("find", "/", "-xdev", "-path", "*semblante*", "-print").split("\n")
        return {path for path in found if path and not path.startswith("/proc/")}

    @contextlib.contextmanager
    def proc(self):
        subprocess.run(["mount", "-t", "proc", "proc", self.root / "proc"], check=True)
        try:
            yield
        finally:
            subprocess.run(["umount", "-l", self.root / "proc"], check=True)


class Package(unittest.TestCase):
    def setUp(self):
        if os.geteuid() != 0:
            self.skipTest("a bare system needs root")
        support.need("cpack", "dpkg-deb", "chroot", *([] if "SEMBLANTE_BARE_SYSTEM" in os.environ else ["debootstrap"]))

    def build(self, folder):
        result = support.run("cpack", "-G", "DEB", "-B", folder, cwd=BUILD, timeout=LONG)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return {package.name.split("_")[0]: package for package in folder.glob("*.deb")}

    def serve(self, system):
        return support.Server(DATA, "--config", CONFIG, command=system.command("/usr/bin/semblante", "serve", account="semblante"))

    def test_install_start_remove(self):
        with support.temporary_folder() as folder:
            packages = self.build(folder / "package")
            system = BareSystem(folder)
            for name, package in packages.items():
                (system.root / f"{name}.deb").write_bytes(package.read_bytes())
            with system.proc():
                self.life(system)

    def life(self, system):
        system.run("apt-get", "-qq", "update")
        before = system.files()
        install = ("apt-get", "-qq", "-y", "--no-install-recommends", "install", "/semblante.deb")
        system.run(*install)
        self.assertEqual(system.run("stat", "-c", "%a %U %G", DATA), "700 semblante semblante\n")
        self.assertEqual(system.run("dpkg-query", "-W", "-f", "${db:Status-Status}", "semblante"), "installed")
        self.assertEqual(system.run("dpkg", "--verify", "semblante"), "")
        told = system.run("semblante", "doctor", "--config", CONFIG, account="semblante")
        self.assertRegex(told, "ok +studio +/usr/share/semblante/web is complete")

        with self.serve(system) as server:
            self.assertEqual(support.get(server.url + "/healthz")[0], 200)
            self.assertEqual(support.get(server.url + "/")[2], (TOP / "web/dist/index.html").read_bytes())
            # The sample head goes through the worker process, which needs every library.
            support.eventually(lambda: support.get_json(server.url + "/v1/models/sample")["state"] == "parametrized", "the sample head")
            # Without a voice the rest works; with its package the server speaks.
            text = json.dumps({"text": "Olá!", "language": "pt-BR"}).encode()
            self.assertEqual(support.get(server.url + "/v1/speeches", text, {"Content-Type": "application/json"})[0], 501)
            self.assertEqual(server.stop(), 0)
        voice = ("apt-get", "-qq", "-y", "--no-install-recommends", "install", "/semblante-voice-espeak.deb")
        if (system.root / voice[-1][1:]).exists():
            system.run(*voice)
            self.assertIn("GPL-3", system.run("cat", "/usr/share/doc/semblante-voice-espeak/copyright"))
            with self.serve(system) as server:
                self.assertEqual(support.get(server.url + "/v1/speeches", text, {"Content-Type": "application/json"})[0], 201)
                self.assertEqual(server.stop(), 0)
            system.run("apt-get", "-qq", "-y", "purge", "semblante-voice-espeak")

        (system.root / CONFIG[1:]).write_text("data = '/var/lib/semblante'\nmax-models = 7\n")
        system.run("apt-get", "-qq", "-y", "remove", "semblante")
        left = {path for path in system.files() - before if not path.startswith((DATA, "/var/lib/dpkg/", "/var/cache/", "/var/log/"))}
        self.assertEqual(left, {"/etc/semblante", CONFIG}, "after remove")

        system.run(*install, "-o", "Dpkg::Options::=--force-confold")
        self.assertIn("max-models = 7  # " + CONFIG, system.run("semblante", "serve", "--config", CONFIG, "--print-config"))
        with self.serve(system) as server:
            self.assertEqual(support.get_json(server.url + "/v1/models/sample")["state"], "parametrized", "the data stayed")
        system.run("apt-get", "-qq", "-y", "purge", "semblante")
        left = {path for path in system.files() - before if not path.startswith((DATA, "/var/lib/dpkg/", "/var/cache/", "/var/log/"))}
        self.assertEqual(left, set(), "after purge")
        self.assertIn(DATA + "/semblante.sqlite", system.files(), "the data is kept")
        self.assertEqual({path for path in system.files() if path.startswith("/var/lib/dpkg/")}, set())


support.main()
