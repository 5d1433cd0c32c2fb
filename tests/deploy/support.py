"""What the tests of this folder share: the programs under test, running servers, requests, skipping with a reason."""

import contextlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.error
import urllib.request

TOP = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("SEMBLANTE_BUILD", TOP / "build")).resolve()
PROGRAM = BUILD / "bin/semblante"
HANG = 60  # seconds that only a hang takes
SKIPPED = 77  # as tests/deploy/CMakeLists.txt tells ctest


def clean_environment(**more):
    """The environment without settings of Semblante, which would change what is tested."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("SEMBLANTE_", "NOTIFY_"))}
    return {**kept, **{name: str(value) for name, value in more.items()}}


def run(*arguments, environment=None, **options):
    """A finished process with its output as text."""
    return subprocess.run([str(a) for a in arguments], env=environment or clean_environment(), capture_output=True, text=True,
                          timeout=options.pop("timeout", HANG), check=False, **options)


def eventually(condition, what):
    deadline = time.monotonic() + HANG
    while True:
        result = condition()
        if result:
            return result
        if time.monotonic() > deadline:
            raise AssertionError(f"waited {HANG} s for {what}")
        time.sleep(0.02)


@contextlib.contextmanager
def temporary_folder():
    folder = tempfile.mkdtemp(prefix="semblante-deploy-")
    try:
        yield pathlib.Path(folder)
    finally:
        shutil.rmtree(folder, ignore_errors=True)


class Server:
    """A running `semblante serve`; `url` is what it says that it listens on."""

    def __init__(self, data, *options, program=PROGRAM, environment=None, command=None):
        self.process = subprocess.Popen([str(a) for a in (command or [program, "serve"])] + ["--data", str(data), "--port", "0"] +
                                        [str(o) for o in options], env=environment or clean_environment(),
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        match = re.fullmatch(r"semblante listening on (https?://\S+)\n", line)
        if not match:
            self.process.kill()
            raise AssertionError(f"the server did not start: {line}{self.process.stderr.read()}")
        self.url = match.group(1)
        self.port = int(self.url.rsplit(":", 1)[1])

    def stop(self):
        """The exit status after SIGTERM."""
        self.process.terminate()
        status = self.process.wait(HANG)
        self.process.stdout.close()
        self.process.stderr.close()
        return status

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.stop()


def get(url, data=None, headers=None, context=None, method=None):
    """(status, headers, body) of a request; an answer that reports an error is an answer."""
    request = urllib.request.Request(url, data=data, headers=headers or {}, method=method)
    try:
        with urllib.request.urlopen(request, timeout=HANG, context=context) as answer:
            return answer.status, answer.headers, answer.read()
    except urllib.error.HTTPError as answer:
        return answer.code, answer.headers, answer.read()


def get_json(url, **options):
    return json.loads(get(url, **options)[2])


def find_program(name):
    """Where a program is installed, or unpacked by tests/run; None if it is neither."""
    folders = [os.environ["PATH"], "/usr/sbin", "/sbin", str(BUILD / "proxies/usr/sbin"), str(BUILD / "proxies/usr/bin")]
    return shutil.which(name, path=":".join(folders))


def need(*programs):
    """Skips the test unless the programs are there."""
    missing = [program for program in programs if find_program(program) is None]
    if missing:
        raise unittest.SkipTest("not installed: " + ", ".join(missing))


def main():
    """Runs the tests of the calling file. When all were skipped, ctest is told so."""
    program = unittest.main(exit=False, verbosity=2)
    result = program.result
    if not result.wasSuccessful():
        sys.exit(1)
    sys.exit(SKIPPED if result.testsRun and len(result.skipped) == result.testsRun else 0)
