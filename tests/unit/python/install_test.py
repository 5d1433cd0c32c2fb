"""`pip install` of the package without network, and the installed package used from another folder."""

import importlib.util
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

TOP = pathlib.Path(__file__).resolve().parents[3]
PACKAGE = TOP / "clients/python"


def environment(**more):
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("PYTHON", "PIP_"))}
    return {**kept, "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PYTHONDONTWRITEBYTECODE": "1", **more}


class Install(unittest.TestCase):
    def test_a_wheel_has_the_library_and_a_record_of_its_files(self):
        sys.path.insert(0, str(PACKAGE / "build_backend"))
        import semblante_build
        with tempfile.TemporaryDirectory() as folder:
            name = semblante_build.build_wheel(folder)
            with zipfile.ZipFile(pathlib.Path(folder, name)) as wheel:
                names = set(wheel.namelist())
                record = next(n for n in names if n.endswith("RECORD"))
                recorded = {line.split(",")[0] for line in wheel.read(record).decode().splitlines()}
            self.assertEqual(names, recorded)
            self.assertIn("semblante/libsemblante.so", names)
            self.assertIn("semblante/py.typed", names)
            self.assertNotIn("any", name)
            source = semblante_build.build_sdist(folder)
            self.assertTrue(pathlib.Path(folder, source).stat().st_size > 1000)
            again = pathlib.Path(folder, "again")
            again.mkdir()
            self.assertEqual(semblante_build.build_wheel(again), name)
            self.assertEqual(pathlib.Path(folder, name).read_bytes(), (again / name).read_bytes())

    def test_the_library_is_that_of_either_preset_and_its_absence_is_said(self):
        with tempfile.TemporaryDirectory() as top:
            package = pathlib.Path(top, "clients/python")
            package.parent.mkdir()
            subprocess.run(["cp", "-r", PACKAGE, package], check=True)
            without_hint = environment(PYTHONPATH=str(package / "build_backend"))
            without_hint.pop("SEMBLANTE_LIBRARY", None)

            def built():
                return subprocess.run([sys.executable, "-c", "import semblante_build; print(semblante_build.build_wheel('.'))"],
                                      env=without_hint, cwd=top, check=True, capture_output=True, text=True)

            alone = built()
            self.assertIn("-any", alone.stdout)
            self.assertIn("the wheel is without it", alone.stderr)
            for folder in ("build/lib", "build/runtime/lib"):
                library = pathlib.Path(top, folder, "libsemblante.so")
                library.parent.mkdir(parents=True)
                library.write_text(folder)
                whole = built()
                self.assertEqual(whole.stderr, "")
                with zipfile.ZipFile(pathlib.Path(top, whole.stdout.strip())) as wheel:
                    self.assertEqual(wheel.read("semblante/libsemblante.so").decode(), folder)

    def test_pip_installs_it_without_network(self):
        if importlib.util.find_spec("pip") is None:
            self.skipTest("pip is not installed")
        with tempfile.TemporaryDirectory() as folder:
            # Built from a copy: pip leaves nothing beside the sources.
            subprocess.run(["cp", "-r", PACKAGE, pathlib.Path(folder, "source")], check=True)
            target = pathlib.Path(folder, "target")
            subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target", target,
                            pathlib.Path(folder, "source")], env=environment(), check=True, timeout=600)
            use = "import semblante; print(semblante.__file__, semblante.from_arkit({'jawOpen': 1}).fap[3] > 0)"
            without_hint = environment(PYTHONPATH=str(target))
            del without_hint["SEMBLANTE_LIBRARY"]
            shown = subprocess.run([sys.executable, "-c", use], env=without_hint, cwd=folder, check=True, capture_output=True,
                                   text=True).stdout
            self.assertEqual(shown.split(), [str(target / "semblante/__init__.py"), "True"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
