"""Builds the wheel of this package with the standard library alone, so that `pip install .` needs no network (PEP 517).

The wheel contains the Python sources and the shared library of the runtime, which is not compiled here but taken from
SEMBLANTE_LIBRARY or from the build folders of the checkout. Without either the wheel has no library, which is said, and the
package then loads the one that the system has installed.
"""

import base64
import gzip
import hashlib
import io
import os
import pathlib
import sys
import sysconfig
import tarfile
import zipfile

try:
    import tomllib
except ImportError:  # Python before 3.11
    tomllib = None

here = pathlib.Path(__file__).resolve().parents[1]
epoch = (2020, 1, 1, 0, 0, 0)  # of every file in the archives: the same sources give the same bytes


def project():
    """Name, version and the other single-line facts of [project]."""
    text = (here / "pyproject.toml").read_text()
    if tomllib:
        return tomllib.loads(text)["project"]
    section = text.split("[project]", 1)[1]
    return {key.strip(): value.strip().strip('"') for key, value in
            (line.split("=", 1) for line in section.splitlines() if "=" in line)}


def metadata():
    facts = project()
    return (
        "Metadata-Version: 2.1\n"
        f"Name: {facts['name']}\nVersion: {facts['version']}\nSummary: {facts['description']}\n"
        f"License: Apache-2.0\nRequires-Python: {facts['requires-python']}\n"
        "Provides-Extra: numpy\nRequires-Dist: numpy; extra == 'numpy'\n"
        "Description-Content-Type: text/markdown\n\n" + (here / "README.md").read_text()
    )


def shared_library():
    """The file to bundle, or None."""
    named = os.environ.get("SEMBLANTE_LIBRARY")
    if named:
        return pathlib.Path(named).resolve(strict=True)
    for folder in ("build/runtime/lib", "build/lib"):  # of the presets `runtime` and `release`
        found = here.parents[1] / folder / "libsemblante.so"
        if found.exists():
            return found.resolve()
    return None


def wheel_name(library):
    facts = project()
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_") if library else "any"
    return f"{facts['name']}-{facts['version']}-py3-none-{platform}"


def source_files(folder):
    """Modules, and the mark that their types are declared (PEP 561)."""
    return sorted(path for path in (here / folder).rglob("*") if path.suffix == ".py" or path.name == "py.typed")


def package_files(library):
    """(name in the wheel, bytes) of what is installed."""
    for path in source_files("semblante"):
        yield str(path.relative_to(here)), path.read_bytes()
    if library:
        yield "semblante/libsemblante.so", library.read_bytes()


def write_wheel(path, name, library):
    facts = project()
    info = f"{facts['name']}-{facts['version']}.dist-info"
    tag = name.split("-", 2)[2]
    files = list(package_files(library))
    files += [
        (f"{info}/METADATA", metadata().encode()),
        (f"{info}/WHEEL", f"Wheel-Version: 1.0\nGenerator: semblante_build\nRoot-Is-Purelib: {str(library is None).lower()}\n"
                          f"Tag: {tag}\n".encode()),
    ]
    record = ""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as wheel:
        for file, content in files:
            digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
            record += f"{file},sha256={digest},{len(content)}\n"
            wheel.writestr(zipfile.ZipInfo(file, epoch), content, zipfile.ZIP_DEFLATED)
        record += f"{info}/RECORD,,\n"
        wheel.writestr(zipfile.ZipInfo(f"{info}/RECORD", epoch), record, zipfile.ZIP_DEFLATED)


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    library = shared_library()
    if library is None:
        print("libsemblante.so was not found in build/runtime/lib or build/lib: the wheel is without it", file=sys.stderr)
    name = wheel_name(library)
    write_wheel(pathlib.Path(wheel_directory, name + ".whl"), name, library)
    return name + ".whl"


def build_sdist(sdist_directory, config_settings=None):
    facts = project()
    stem = f"{facts['name']}-{facts['version']}"
    files = [here / "pyproject.toml", here / "README.md"]
    for folder in ("semblante", "build_backend", "examples"):
        files += source_files(folder)
    tar_bytes = io.BytesIO()
    with tarfile.open(fileobj=tar_bytes, mode="w") as archive:
        for name, content in [("PKG-INFO", metadata().encode())] + [(str(f.relative_to(here)), f.read_bytes()) for f in files]:
            entry = tarfile.TarInfo(f"{stem}/{name}")
            entry.size = len(content)
            archive.addfile(entry, io.BytesIO(content))
    with open(pathlib.Path(sdist_directory, stem + ".tar.gz"), "wb") as out:
        with gzip.GzipFile(fileobj=out, mode="wb", mtime=0) as packed:
            packed.write(tar_bytes.getvalue())
    return stem + ".tar.gz"


def get_requires_for_build_wheel(config_settings=None):
    return []


def get_requires_for_build_sdist(config_settings=None):
    return []
