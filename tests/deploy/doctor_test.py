"""`semblante doctor`: each fault of an installation is told with a remedy; a sound one has none."""

import contextlib
import os
import re
import shutil
import socket
import sqlite3
import unittest

import support
from support import PROGRAM, run


def findings(output):
    """{subject: [(level, message)]} of the lines that are no remedies."""
    told = {}
    for line in output.splitlines():
        level, subject, message = line[:9].strip(), line[9:22].strip(), line[22:]
        if level:
            told.setdefault(subject, []).append((level, message))
    return told


class Doctor(unittest.TestCase):
    def setUp(self):
        folder = support.temporary_folder()
        self.folder = folder.__enter__()
        self.addCleanup(folder.__exit__, None, None, None)
        self.web = self.folder / "web"
        (self.web / "assets").mkdir(parents=True)
        (self.web / "draco").mkdir()
        (self.web / "index.html").write_text('<script src="./assets/index.js"></script><a href="https://example.org/">x</a>')
        for name in ("assets/index.js", "semblante_view.wasm", "semblante_motion.wasm", "semblante_listen.wasm", "semblante_speak.wasm", "draco/draco_decoder.wasm", "draco/draco_wasm_wrapper.js",
                     "listen_worklet.js"):
            (self.web / name).write_text("x")

    def doctor(self, *options, data=None, port=0, under=()):
        result = run(*under, PROGRAM, "doctor", "--data", data or self.folder / "data", "--port", port, "--web-root", self.web, *options)
        # A fault has a remedy, and nothing else has one.
        self.assertEqual(len(re.findall(r"^(?:warning|error) ", result.stdout, re.MULTILINE)), result.stdout.count("\n" + 22 * " " + "-> "))
        self.assertEqual(result.returncode, 1 if "\nerror " in "\n" + result.stdout else 0, result.stdout + result.stderr)
        return findings(result.stdout)

    def levels(self, told, subject):
        return {level for level, _ in told[subject]}

    def test_a_sound_installation(self):
        told = self.doctor()
        self.assertEqual({subject for subject in told if "error" in self.levels(told, subject)}, set())
        for subject in ("data folder", "address", "studio", "worker", "clock"):
            self.assertEqual(self.levels(told, subject), {"ok"}, subject)
        self.assertFalse((self.folder / "data").exists(), "it makes nothing")

    def test_data_folder_that_is_a_file(self):
        (self.folder / "data").write_text("x")
        self.assertEqual(self.levels(self.doctor(), "data folder"), {"error"})

    def test_data_folder_that_cannot_be_written(self):
        told = self.doctor(data="/proc/semblante")
        self.assertEqual(self.levels(told, "data folder"), {"error"})

    def test_data_folder_of_another_account(self):
        if os.geteuid() != 0:
            self.skipTest("only root can give a folder away")
        data = self.folder / "data"
        data.mkdir(mode=0o700)
        os.chown(data, 12345, 12345)
        self.assertEqual(self.levels(self.doctor(), "data folder"), {"ok", "warning"})
        self.assertEqual(self.levels(self.doctor(under=self.as_stranger()), "data folder"), {"error"})

    def as_stranger(self):
        """The beginning of a command that runs as an account without rights; skips where the program is out of its reach."""
        if os.geteuid() != 0:
            self.skipTest("only root can become another account")
        os.chmod(self.folder, 0o755)
        command = ("setpriv", "--reuid=12346", "--regid=12346", "--clear-groups")
        if run(*command, PROGRAM, "--version").returncode != 0:
            self.skipTest("other accounts cannot reach the program")
        return command

    def test_databases_that_the_server_refuses(self):
        data = self.folder / "data"
        with support.Server(data):
            pass
        self.assertEqual(self.levels(self.doctor(), "database"), {"ok"})
        later = self.folder / "later"
        shutil.copytree(data, later)
        with contextlib.closing(sqlite3.connect(later / "semblante.sqlite")) as database:
            database.execute("PRAGMA user_version = 1000")
        foreign = self.folder / "foreign"
        foreign.mkdir(mode=0o700)
        with contextlib.closing(sqlite3.connect(foreign / "semblante.sqlite")) as database:
            database.execute("CREATE TABLE songs(name)")
        damaged = self.folder / "damaged"
        damaged.mkdir(mode=0o700)
        (damaged / "semblante.sqlite").write_text("x" * 10000)
        for folder, word in ((later, "a later version"), (foreign, "another program"), (damaged, "not a database")):
            with self.subTest(folder.name):
                before = (folder / "semblante.sqlite").read_bytes()
                [(level, message)] = self.doctor(data=folder)["database"]
                self.assertEqual(level, "error")
                self.assertIn(word, message)
                refused = run(PROGRAM, "serve", "--data", folder, "--port", 0, "--web-root", "")
                self.assertNotEqual(refused.returncode, 0)
                self.assertIn(word, refused.stderr)
                self.assertEqual((folder / "semblante.sqlite").read_bytes(), before, "nothing is changed")

    def test_data_folder_open_to_others(self):
        (self.folder / "data").mkdir()
        os.chmod(self.folder / "data", 0o755)
        self.assertIn("warning", self.levels(self.doctor(), "data folder"))

    def test_port_that_is_taken(self):
        with socket.create_server(("127.0.0.1", 0)) as taken:
            self.assertEqual(self.levels(self.doctor(port=taken.getsockname()[1]), "address"), {"error"})

    def test_beside_a_running_server(self):
        data = self.folder / "data"
        with support.Server(data) as server:
            told = self.doctor(port=server.port)
        self.assertEqual(self.levels(told, "address"), {"ok"})
        self.assertIn("a server runs in it", told["data folder"][0][1])

    def test_studio_without_a_file(self):
        for name in ("index.html", "assets/index.js", "semblante_view.wasm", "semblante_motion.wasm", "draco/draco_decoder.wasm"):
            with self.subTest(name):
                text = (self.web / name).read_text()
                (self.web / name).unlink()
                told = self.doctor()
                self.assertEqual(self.levels(told, "studio"), {"error"})
                self.assertIn(name, told["studio"][0][1])
                (self.web / name).write_text(text)

    def test_private_files_in_the_web_root(self):
        told = self.doctor(data=self.web / "data")
        self.assertIn(("error", f"--data: {self.web}/data lies within --web-root {self.web}, whose files everybody can read; choose a place outside of it"), told["studio"])
        key = self.web / "key.pem"
        self.assertIn("error", self.levels(self.doctor("--tls-cert", key, "--tls-key", key), "studio"))

    def test_sample_without_its_points(self):
        (self.folder / "head.glb").write_text("x")
        self.assertEqual(self.levels(self.doctor("--sample", self.folder / "head.glb"), "sample head"), {"error"})
        (self.folder / "head.fps.json").write_text("{}")
        self.assertEqual(self.levels(self.doctor("--sample", self.folder / "head.glb"), "sample head"), {"ok"})

    def test_sample_that_is_a_folder(self):
        told = self.doctor("--sample", self.folder)
        self.assertEqual(self.levels(told, "sample head"), {"error"})
        self.assertIn("is a folder", told["sample head"][0][1])

    def test_worker_that_does_not_start(self):
        data = self.folder / "data"
        data.mkdir(mode=0o700)
        os.chown(data, 12346, 12346) if os.geteuid() == 0 else None
        self.assertEqual(self.levels(self.doctor(under=self.as_stranger()), "worker"), {"ok"})
        self.assertEqual(self.levels(self.doctor(under=("prlimit", "--nproc=1", *self.as_stranger())), "worker"), {"error"})

    def test_clock_set_back(self):
        (self.folder / "data").mkdir(mode=0o700)
        (self.folder / "data/last-database").write_text("x")
        os.utime(self.folder / "data/last-database", (4e9, 4e9))
        self.assertEqual(self.levels(self.doctor(), "clock"), {"warning"})

    def certificate(self, name, days):
        support.need("openssl")
        made = run("openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-subj", "/CN=x", "-days", days,
                   "-keyout", self.folder / f"{name}.key", "-out", self.folder / f"{name}.pem")
        self.assertEqual(made.returncode, 0, made.stderr)
        return self.folder / f"{name}.pem", self.folder / f"{name}.key"

    def tls(self, certificate, key):
        return self.doctor("--tls-cert", certificate, "--tls-key", key)["TLS"]

    def test_certificates(self):
        certificate, key = self.certificate("good", 100)
        self.assertEqual(self.tls(certificate, key)[0][0], "ok")
        other, _ = self.certificate("other", 100)
        self.assertIn("is not the key of", self.tls(other, key)[0][1])
        self.assertEqual(self.tls(*self.certificate("soon", 3))[0][0], "warning")
        self.assertEqual(self.tls(key, key)[0], ("error", f"{key} is no certificate in PEM form"))
        self.assertEqual(self.tls(certificate, certificate)[0][0], "error")
        self.assertEqual(self.tls(self.folder / "none", key)[0][0], "error")
        alone = run(PROGRAM, "doctor", "--tls-cert", certificate)
        self.assertEqual(alone.returncode, 1)
        self.assertIn("--tls-cert and --tls-key are given together", alone.stdout)

    def test_expired_certificate(self):
        certificate, key = self.certificate("old", 100)
        request, old = self.folder / "old.csr", self.folder / "old2.pem"
        run("openssl", "req", "-new", "-key", key, "-subj", "/CN=x", "-out", request)
        (self.folder / "index").write_text("")
        (self.folder / "ca.cnf").write_text(
            f"[ca]\ndefault_ca=c\n[c]\ndatabase={self.folder}/index\nnew_certs_dir={self.folder}\ndefault_md=sha256\nrand_serial=yes\n"
            "policy=p\n[p]\ncommonName=supplied\n")
        made = run("openssl", "ca", "-batch", "-selfsign", "-config", self.folder / "ca.cnf", "-keyfile", key, "-in", request, "-out", old,
                   "-startdate", "20200101000000Z", "-enddate", "20200201000000Z")
        self.assertEqual(made.returncode, 0, made.stderr)
        self.assertIn("has expired", self.tls(old, key)[0][1])


support.main()
