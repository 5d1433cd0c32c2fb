"""One version: what is built, what it says, and what the changelog has as its last release (a git tag vX.Y.Z, where there are tags)."""

import json
import re
import subprocess
import unittest

import support
from support import PROGRAM, TOP, run

CHANGELOG = (TOP / ".github/CHANGELOG.md").read_text()
PROJECT = re.search(r"^project\(semblante VERSION (\d+\.\d+\.\d+)", (TOP / "CMakeLists.txt").read_text(), re.MULTILINE).group(1)
SECTIONS = re.findall(r"^## (.+)$", CHANGELOG, re.MULTILINE)
RELEASED = r"(\d+)\.(\d+)\.(\d+)(?: - \d{4}-\d{2}-\d{2})?"


class Version(unittest.TestCase):
    def test_program_says_it(self):
        self.assertEqual(run(PROGRAM, "--version").stdout, f"semblante {PROJECT}\n")
        self.assertEqual(run(PROGRAM, "version").stdout, f"semblante {PROJECT}\n")
        with support.temporary_folder() as folder, support.Server(folder / "data") as server:
            self.assertEqual(support.get_json(server.url + "/version"), {"name": "semblante", "version": PROJECT, "api": "v1"})
            self.assertIn(f'semblante_build_info{{version="{PROJECT}"}} 1', support.get(server.url + "/metrics")[2].decode())

    def test_the_same_elsewhere(self):
        for package in ("web/package.json", "web/package-lock.json", "clients/js/package.json"):
            self.assertEqual(json.loads((TOP / package).read_text())["version"], PROJECT, package)
        for file in ("clients/python/pyproject.toml", "clients/python/semblante/__init__.py"):
            self.assertIn(f'version{"__" if file.endswith("py") else ""} = "{PROJECT}"', (TOP / file).read_text(), file)
        minor_version = PROJECT.rpartition(".")[0]
        self.assertIn(f"find_package(semblante {minor_version} REQUIRED)", (TOP / "clients/runtime/README.md").read_text())
        self.assertIn(f"set(VERSION {minor_version} ", (TOP / "tests/integration/sdk/consumer/CMakeLists.txt").read_text())
        major, minor, patch = (int(part) for part in PROJECT.split("."))
        sdk = re.search(r"SEMBLANTE_SDK_VERSION (0x\w+)u", (TOP / "clients/runtime/semblante.h").read_text()).group(1)
        self.assertEqual(int(sdk, 16), major << 16 | minor << 8 | patch)

    def test_changelog(self):
        self.assertEqual(SECTIONS[0], "Unreleased")
        versions = [tuple(int(part) for part in re.fullmatch(RELEASED, section).groups()) for section in SECTIONS[1:]]
        self.assertEqual(versions, sorted(set(versions), reverse=True))
        self.assertEqual(".".join(str(part) for part in versions[0]), PROJECT, "the last release is what is built, until the next")

    def test_tags(self):
        tags = subprocess.run(["git", "-C", TOP, "tag", "--list"], capture_output=True, text=True, check=False)
        if tags.returncode != 0:
            self.skipTest("not a git repository")
        for tag in tags.stdout.split():
            self.assertRegex(tag, r"^v\d+\.\d+\.\d+$", "a tag is vMAJOR.MINOR.PATCH (.github/CONTRIBUTING.md)")
            self.assertIn(tag[1:], [section.split()[0] for section in SECTIONS])


support.main()
