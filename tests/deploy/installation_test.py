"""`cmake --install` into a folder of its own: the program works there, and after the folder was moved, without options."""

import json
import re
import shutil
import subprocess
import unittest

import support
from support import BUILD, TOP, run

STUDIO = TOP / "web/dist/index.html"


class Installation(unittest.TestCase):
    def setUp(self):
        if not STUDIO.is_file() or not (BUILD / "sample/sample-head.glb").is_file():
            self.skipTest("the studio or the sample head is not built: deploy/run --build-only")
        folder = support.temporary_folder()
        self.folder = folder.__enter__()
        self.addCleanup(folder.__exit__, None, None, None)
        self.prefix = self.folder / "prefix"

    def install(self, *arguments, **environment):
        result = run("cmake", "--install", BUILD, *arguments, environment=support.clean_environment(**environment))
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def check_program(self, prefix):
        program = prefix / "bin/semblante"
        with support.Server(self.folder / "data", program=program) as server:
            status, headers, page = support.get(server.url + "/")
            self.assertEqual((status, page), (200, STUDIO.read_bytes()))
            self.assertEqual(support.get(server.url + "/v1/models/sample")[0], 200)
            for name in ("/semblante_view.wasm", "/semblante_motion.wasm"):
                self.assertEqual(support.get(server.url + name)[0], 200)
        told = run(program, "doctor", "--data", self.folder / "data", "--port", "0")
        self.assertEqual(told.returncode, 0, told.stdout)
        self.assertNotIn("\nerror", told.stdout)
        self.assertRegex(told.stdout, f"ok +studio +{re.escape(str(prefix))}/share/semblante/web is complete")

    def test_the_program_finds_its_files_also_when_moved(self):
        self.install("--prefix", self.prefix)
        self.check_program(self.prefix)
        moved = self.prefix.rename(self.folder / "moved")
        self.check_program(moved)
        libraries = run("ldd", moved / "bin/semblante").stdout
        self.assertNotIn("not found", libraries)
        self.assertNotIn(str(BUILD), libraries)

    def test_the_voice_is_a_component_that_the_program_finds(self):
        if not (BUILD / "bin/semblante-voice-espeak").is_file():
            self.skipTest("semblante-voice-espeak is not built")
        for component in ("server", "libraries"):
            self.install("--prefix", self.prefix, "--component", component)
        say = (self.prefix / "bin/semblante", "say", "Olá!", "--language", "pt-BR", "--audio", self.folder / "ola.wav")
        told = run(*say)
        self.assertNotEqual(told.returncode, 0)
        self.assertIn("semblante-voice-espeak is not installed", told.stderr)
        self.install("--prefix", self.prefix, "--component", "voice")
        told = run(*say)
        self.assertEqual(told.returncode, 0, told.stderr)
        self.assertEqual((self.folder / "ola.wav").read_bytes()[:4], b"RIFF")
        notice = (self.prefix / "share/doc/semblante-voice-espeak/copyright").read_text()
        self.assertIn("License: GPL-3+", notice)

    def test_what_is_installed(self):
        self.install("--prefix", self.prefix)
        self.assertEqual((self.prefix / "share/doc/semblante/copyright").read_bytes(), (TOP / "LICENSE").read_bytes())
        self.assertEqual((self.prefix / "share/semblante/schemas/openapi.json").read_bytes(), (TOP / "server/api/openapi.json").read_bytes())
        unit = (self.prefix / "lib/systemd/system/semblante.service").read_text()
        command = re.search("^ExecStart=(.*)$", unit, re.MULTILINE).group(1).split()
        self.assertEqual(command[0], str(self.prefix / "bin/semblante"))
        self.assertNotIn("@program@", unit)
        # The command of the unit, up to its start: the file is a configuration that the program takes.
        printed = subprocess.run([*command, "--print-config"], capture_output=True, text=True, check=True).stdout
        self.assertIn('data = "/var/lib/semblante"  # ' + command[-1], printed)
        self.assertEqual([path.name for path in self.prefix.rglob(".*")], [], "files of the build")

    def test_every_key_of_the_configuration_is_one(self):
        # Those in comments too.
        text = re.sub("^# ([a-z-]+ = )", r"\1", (TOP / "deploy/package/semblante.toml").read_text(), flags=re.MULTILINE)
        self.assertGreater(len(re.findall("^[a-z-]+ = ", text, re.MULTILINE)), 8)
        (self.folder / "all.toml").write_text(text)
        result = run(support.PROGRAM, "serve", "--config", self.folder / "all.toml", "--print-config")
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_a_configuration_that_is_there_is_kept(self):
        self.install("--prefix", self.prefix)
        config = self.prefix / "etc/semblante/semblante.toml"
        config.write_text("port = 1\n")
        self.assertIn("Kept: " + str(config), self.install("--prefix", self.prefix))
        self.assertEqual(config.read_text(), "port = 1\n")

    def test_staged_for_a_package(self):
        self.install("--prefix", "/usr", DESTDIR=self.folder)
        self.assertTrue((self.folder / "etc/semblante/semblante.toml").is_file())
        unit = (self.folder / "usr/lib/systemd/system/semblante.service").read_text()
        self.assertIn("\nExecStart=/usr/bin/semblante serve --config /etc/semblante/semblante.toml\n", unit)
        self.assertNotIn(str(self.folder), unit)


class Update(unittest.TestCase):
    def test_jobs_run_in_the_program_of_the_server_also_when_its_file_is_another(self):
        with support.temporary_folder() as folder:
            program = folder / "semblante"
            shutil.copy2(support.PROGRAM, program)
            with support.Server(folder / "data", program=program) as server:
                other = folder / "other"
                other.write_text("#!/bin/sh\nexit 1\n")
                other.chmod(0o755)
                other.rename(program)
                model = (TOP / "tests/deploy/tetrahedron.obj").read_bytes()
                answer = support.get(server.url + "/v1/models?filename=a.obj", model, {"Content-Type": "model/obj"})[2]
                job = server.url + "/v1/jobs/" + json.loads(answer)["job"]["id"]

                def ended():
                    now = support.get_json(job)
                    return now["state"] not in ("queued", "running") and now

                self.assertEqual(support.eventually(ended, "the import")["state"], "done")


support.main()
