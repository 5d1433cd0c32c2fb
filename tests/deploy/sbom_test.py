"""The SBOM names every library: held against the loader, the #includes, the studio's imports and the image; NOTICE agrees with it."""

import json
import os
import pathlib
import re
import shutil
import unittest

import support
from support import BUILD, TOP, run

PURPOSES = {"APPLICATION", "LIBRARY", "CONTAINER", "OTHER"}
LICENCE = re.compile(r"[A-Za-z0-9.-]+( (WITH|OR|AND) [A-Za-z0-9.-]+)*")
# Other people's code that #includes and imports name, by what they begin with, and the component that must be listed.
INCLUDED = {"boost/": "libboost", "nlohmann/": "nlohmann-json3-dev", "glm/": "libglm-dev", "CLI/": "libcli11-dev", "tiny_gltf.h": "libtinygltf-dev",
            "stb/": "libstb-dev", "openssl/": "libssl", "opus.h": "libopus", "ogg/": "libogg", "samplerate.h": "libsamplerate", "qrencode.h": "libqrencode", "sqlite3.h": "libsqlite3", "zlib.h": "zlib1g", "zip.h": "libzip", "webp/": "libwebp",
            "meshoptimizer.h": "libmeshoptimizer", "draco/": "libdraco", "OpenMesh/": "libopenmesh", "Eigen/": "libeigen3-dev"}
# Programs of their own, each in a package of its own; that of the voice is under the licence of its library.
APART = ("server/voice/espeak", "server/voice/pocketsphinx", "server/voice/sound")
SYSTEM = re.compile(r"(sys|net|netinet|arpa|linux|asm)/|[a-z0-9_]+(\.h)?$")


class Sbom(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        support.need("ninja", "dpkg", "ldd")
        if not (BUILD / "build.ninja").is_file():
            raise unittest.SkipTest("the build is not ninja's")
        cls.holder = support.temporary_folder()
        cls.folder = cls.holder.__enter__()
        cls.environment = support.clean_environment(SEMBLANTE_BUILD=BUILD, SOURCE_DATE_EPOCH=1_700_000_000)
        result = run(TOP / "deploy/sbom/make", "--out", cls.folder, environment=cls.environment, timeout=600)
        assert result.returncode == 0, result.stdout + result.stderr
        cls.documents = {path.name.removesuffix(".spdx.json"): json.loads(path.read_text()) for path in cls.folder.glob("*.spdx.json")}

    @classmethod
    def tearDownClass(cls):
        if hasattr(cls, "holder"):
            cls.holder.__exit__(None, None, None)

    def names(self, document):
        return {package["name"] for package in self.documents[document]["packages"]}

    def test_documents_are_spdx(self):
        self.assertLessEqual({"semblante", "studio"}, set(self.documents))
        for name, document in self.documents.items():
            self.assertEqual((document["spdxVersion"], document["dataLicense"], document["SPDXID"]), ("SPDX-2.3", "CC0-1.0", "SPDXRef-DOCUMENT"))
            self.assertRegex(document["documentNamespace"], r"^https://[^#\s]+$")
            self.assertEqual(document["creationInfo"]["created"], "2023-11-14T22:13:20Z")
            self.assertRegex(document["creationInfo"]["creators"][0], r"^Tool: \S+$")
            defined = {text["licenseId"] for text in document["hasExtractedLicensingInfos"] if text["extractedText"]}
            used = {part for package in document["packages"] for part in re.findall(r"LicenseRef-[A-Za-z0-9.-]+", package["licenseConcluded"])}
            self.assertEqual(defined, used, name)
            ids = [package["SPDXID"] for package in document["packages"]]
            self.assertEqual(len(set(ids)), len(ids))
            for package in document["packages"]:
                self.assertRegex(package["SPDXID"], r"^SPDXRef-[A-Za-z0-9.-]+$")
                self.assertTrue(LICENCE.fullmatch(package["licenseConcluded"]), package)
                self.assertNotEqual(package["versionInfo"], "")
                self.assertIn(package["primaryPackagePurpose"], PURPOSES)
                for key in ("name", "downloadLocation", "filesAnalyzed", "copyrightText", "licenseDeclared"):
                    self.assertIn(key, package)
            related = document["relationships"]
            self.assertIn("DESCRIBES", [relation["relationshipType"] for relation in related])
            for relation in related:
                self.assertIn(relation["spdxElementId"], [*ids, "SPDXRef-DOCUMENT"], name)
                self.assertIn(relation["relatedSpdxElement"], ids, name)
            # Everything is reached from what the document describes.
            self.assertEqual({end for relation in related for end in (relation["spdxElementId"], relation["relatedSpdxElement"])} - set(ids),
                             {"SPDXRef-DOCUMENT"})
            self.assertLessEqual(set(ids), {end for relation in related for end in (relation["spdxElementId"], relation["relatedSpdxElement"])})

    def test_every_library_of_the_program(self):
        listed = {name for package in self.documents["semblante"]["packages"] for name in package.get("comment", "").split()}
        loaded = set(re.findall(r"^\s*(?:\S*/)?(\S+?)(?: =>.*)? \(0x", run("ldd", support.PROGRAM).stdout, re.MULTILINE)) - {"linux-vdso.so.1"}
        self.assertGreater(len(loaded), 8)
        self.assertEqual(listed, loaded)

    def test_the_voice_is_apart_and_under_the_licence_of_its_library(self):
        if "voice" not in self.documents:
            self.skipTest("semblante-voice-espeak is not built")
        packages = {package["name"]: package for package in self.documents["voice"]["packages"]}
        self.assertEqual(packages["voice"]["licenseConcluded"], "GPL-3.0-or-later")
        self.assertEqual(packages["libespeak-ng1"]["licenseConcluded"], "GPL-3.0-or-later")
        self.assertNotIn("libespeak-ng1", self.names("semblante"))
        for package in self.documents["semblante"]["packages"]:
            self.assertNotRegex(package["licenseConcluded"], r"^A?GPL-[\d.]+(-only|-or-later)$", package["name"])
        listed = {name for package in packages.values() for name in package.get("comment", "").split()}
        loaded = set(re.findall(r"^\s*(?:\S*/)?(\S+?)(?: =>.*)? \(0x", run("ldd", BUILD / "bin/semblante-voice-espeak").stdout, re.MULTILINE))
        self.assertEqual(listed, loaded - {"linux-vdso.so.1"})

    def test_the_other_programs_apart_are_listed_with_their_libraries(self):
        for name, program, library in (("sound", "semblante-sound", "libsndfile1"), ("recognizer", "semblante-recognizer-pocketsphinx", "libpocketsphinx3")):
            with self.subTest(name):
                if not (BUILD / "bin" / program).is_file():
                    self.skipTest(f"{program} is not built")
                packages = {package["name"]: package for package in self.documents[name]["packages"]}
                self.assertEqual(packages[name]["licenseConcluded"], "Apache-2.0")
                self.assertIn(library, packages)
                self.assertNotIn(library, self.names("semblante"))
                listed = {one for package in packages.values() for one in package.get("comment", "").split()}
                loaded = set(re.findall(r"^\s*(?:\S*/)?(\S+?)(?: =>.*)? \(0x", run("ldd", BUILD / "bin" / program).stdout, re.MULTILINE))
                self.assertEqual(listed, loaded - {"linux-vdso.so.1"})

    def test_every_include_of_the_program(self):
        used, unknown = set(), set()
        for layer in ("core", "protocol", "server"):
            for path in (TOP / layer).rglob("*"):
                if path.suffix not in (".h", ".cpp", ".c") or "/codegen/" in str(path) or any(path.is_relative_to(TOP / folder) for folder in APART):
                    continue
                for name in re.findall(r"^\s*#\s*include <([^>]+)>", path.read_text(encoding="utf-8"), re.MULTILINE):
                    component = next((known for begin, known in INCLUDED.items() if name.startswith(begin)), None)
                    if component:
                        used.add(component)
                    elif not SYSTEM.match(name):
                        unknown.add(name)
        self.assertEqual(unknown, set(), "includes of a library that this test does not know")
        missing = {component for component in used if not any(name.startswith(component) for name in self.names("semblante"))}
        self.assertEqual(missing, set())

    def test_every_import_of_the_studio(self):
        imported = set()
        for folder in ("web/src", "clients/js", "protocol/ts"):
            for path in (TOP / folder).rglob("*.ts"):
                text = path.read_text(encoding="utf-8")
                imported |= set(re.findall(r"""(?:\bfrom|\bimport\(|^import)\s*['"](@?[a-z][\w./-]*)['"]""", text, re.MULTILINE))
        packages = {"/".join(name.split("/")[:2 if name.startswith("@") else 1]) for name in imported}
        packages = {name for name in packages if not name.startswith(("@protocol", "@client", "node:"))}
        self.assertIn("three", packages)
        self.assertLessEqual(packages, self.names("studio"))
        # Files that the build copies from a package: the decoder of Draco is of another author.
        config = (TOP / "web/vite.config.ts").read_text()
        copied = set(re.findall(r"here\('node_modules/([^'\"]*)", config))
        self.assertEqual(copied, {"three/examples/jsm/libs/draco/gltf/"})
        self.assertIn("draco-decoder", self.names("studio"))

    def test_image(self):
        if "image" not in self.documents:
            self.skipTest("no file system of the image: deploy/image/rootfs")
        self.assertLess({name for name in self.names("semblante") if name != "linux-libc-dev"}, self.names("image"))
        self.assertLess(self.names("studio"), self.names("image"))

    def test_notice_names_the_same(self):
        text = (TOP / "deploy/NOTICE").read_text(encoding="utf-8")
        told = set(re.findall(r"^  (\S+) \(.*\), https://\S+$", text, re.MULTILINE))
        if 'VERSION_ID="12"' not in pathlib.Path("/etc/os-release").read_text():
            self.skipTest("deploy/NOTICE has the names of Debian 12's source packages")
        listed = {package["sourceInfo"].split()[-1] if "sourceInfo" in package else package["name"]
                  for name in ("semblante", "studio") for package in self.documents[name]["packages"]} - {"semblante", "studio", "linux"}
        self.assertEqual(told, listed, "deploy/sbom/make --notice writes it")
        # MIT and BSD ask for their text beside copies in any form; these are in ours.
        for name in ("cli11", "glm", "nlohmann-json3", "tinygltf", "three"):
            self.assertRegex(text, rf"(?m)^=+\n{name}\n=+\n(?:.*\n)*?.*[Cc]opyright")

    def test_a_component_without_a_licence_stops_it(self):
        with support.temporary_folder() as folder:
            for part in ("deploy/sbom", "web"):
                (folder / part).mkdir(parents=True)
            shutil.copy(TOP / "deploy/sbom/make", folder / "deploy/sbom/make")
            os.symlink(TOP / "build", folder / "build")
            lock = json.loads((TOP / "web/package-lock.json").read_text())
            lock["packages"]["node_modules/strange"] = {"version": "1.0.0"}
            (folder / "web/package-lock.json").write_text(json.dumps(lock))
            shutil.copy(TOP / "deploy/sbom/licenses.json", folder / "deploy/sbom/licenses.json")
            environment = {**self.environment, "SEMBLANTE_BUILD": str(BUILD)}
            result = run("python3", folder / "deploy/sbom/make", "--out", folder / "out", environment=environment, timeout=600)
            self.assertEqual(result.returncode, 1)
            self.assertIn("strange", result.stderr)


support.main()
