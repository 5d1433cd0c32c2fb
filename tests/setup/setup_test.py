"""deploy/lib/setup.sh beside programs of Debian that only note how they were called: nothing is installed or fetched."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

TOP = pathlib.Path(__file__).resolve().parents[2]
SETUP = TOP / "deploy/lib/setup.sh"

# The environment says what the system is like: INSTALLED and OFFERED (packages), PLAN (apt-get's answer), BROKEN (the program
# that fails). Each call is a line of $CALLS.
PROGRAMS = {
    "id": "echo 0",
    "node": "exit 0",
    "npm": "exit 0",
    "dpkg-query": 'case " $INSTALLED " in *" $4 "*) echo "install ok installed" ;; *) exit 1 ;; esac',
    "apt-cache": """case $1 in
  policy) case " $OFFERED " in *" $2 "*) echo "  Candidate: 1.0" ;; *) echo "  Candidate: (none)" ;; esac ;;
  depends) printf 'libopenmesh-dev\\n  Depends: libopenmesh7.5\\n  Depends: libopenscenegraph-dev\\n' ;;
esac""",
    "apt-get": """echo "apt-get $*" >>"$CALLS"
[ "$BROKEN" != "$1" ] || { echo "E: no mirror"; exit 100; }
case $* in
  *--assume-no*) echo "$PLAN"; exit 1 ;;
  *download*) shift 2; for name; do echo "$name" >"$name.deb"; done ;;
esac""",
    "dpkg-deb": """[ "$BROKEN" != "$2" ] || { echo "broken archive"; exit 2; }
mkdir -p "$3/usr" && cp "$2" "$3/usr/$(cat "$2")" """,
}
UPDATE = "apt-get -qq update"
PLANNED = "apt-get install --no-install-recommends --assume-no --download-only "
INSTALLED = "apt-get install -qq -y --no-install-recommends "
DOWNLOADED = "apt-get -qq download "
OPENMESH = DOWNLOADED + "libopenmesh-dev libopenmesh7.5"

failures = 0


def expect(what, actual, wanted):
    global failures
    if actual != wanted:
        failures += 1
        print(f"FAILED: {what}: {actual!r}, not {wanted!r}")


class System:
    """An empty checkout on a machine with the programs above."""

    def __init__(self, folder):
        self.root = pathlib.Path(folder)
        for name, script in PROGRAMS.items():
            path = self.root / "bin" / name
            path.parent.mkdir(exist_ok=True)
            path.write_text(f"#!/bin/sh\n{script}\n")
            path.chmod(0o755)

    def run(self, commands, **environment):
        """The exit status, what was printed and the calls of apt-get."""
        calls = self.root / "calls"
        calls.write_text("")
        settings = {"INSTALLED": "", "OFFERED": "", "PLAN": "", "BROKEN": "", **environment}
        settings.update(CALLS=str(calls), PATH=f"{self.root}/bin:{os.environ['PATH']}")
        script = f'set -euo pipefail; root="{self.root}"; . "{SETUP}"; {commands}'
        result = subprocess.run(["bash", "-c", script], env={**os.environ, **settings}, capture_output=True, text=True)
        return result.returncode, result.stdout + result.stderr, calls.read_text().splitlines()


def each(check):
    with tempfile.TemporaryDirectory() as folder:
        check(System(folder))


def installs_what_is_missing(system):
    names = "install_packages one 'two|zwei' 'three|drei|tres'"
    expect("all installed", system.run(names, INSTALLED="one zwei tres"), (0, "", []))
    status, output, calls = system.run(names, INSTALLED="one", OFFERED="zwei three drei", PLAN="Need to get 3 MB of archives.")
    expect("alternatives", (status, calls), (0, [UPDATE, PLANNED + "zwei three", INSTALLED + "zwei three"]))
    expect("the plan is told", "Packages to install: zwei three" in output and "Need to get 3 MB" in output, True)


def removes_nothing(system):
    status, output, calls = system.run("install_packages one", OFFERED="one", PLAN="0 upgraded, 1 newly installed, 2 to remove")
    expect("a plan that removes", (status, calls), (1, [UPDATE, PLANNED + "one"]))
    expect("its message", "would remove the packages" in output, True)


def names_what_failed(system):
    for plan in ("E: Package 'one' has no installation candidate", "one : Depends: two but it is not installable\nE: Unable to correct"):
        status, output, calls = system.run("install_packages one", PLAN=plan)
        expect("no plan", (status, calls, plan in output), (1, [UPDATE, PLANNED + "one"], True))
    status, output, _ = system.run("install_packages one", OFFERED="one", BROKEN="install")
    expect("a failed install", (status, "E: no mirror" in output), (1, True))
    status, output, _ = system.run("install_packages one", BROKEN="-qq")
    expect("a failed update", (status, "is a mirror of packages reachable?" in output), (1, True))


def unpacks_openmesh_once(system):
    tree = system.root / "build/packages"
    expect("OpenMesh installed", system.run("unpack_openmesh", INSTALLED="libopenmesh-dev"), (0, "", []))
    expect("OpenMesh installed: nothing unpacked", tree.exists(), False)
    status, _, calls = system.run("install_packages one; unpack_openmesh", OFFERED="one")
    expect("one update for both", (status, calls), (0, [UPDATE, PLANNED + "one", INSTALLED + "one", OPENMESH]))
    expect("what is unpacked", sorted(str(file.relative_to(tree)) for file in tree.rglob("*") if file.is_file()),
           ["usr/libopenmesh-dev", "usr/libopenmesh7.5"])
    expect("the second time", system.run("unpack_openmesh"), (0, "", []))


def unpacks_openmesh_whole_or_not(system):
    build = system.root / "build"
    for broken in ("-qq", "libopenmesh7.5.deb"):  # apt-get's update and download; the second archive
        status, output, _ = system.run("lists_are_fresh=yes; unpack_openmesh", BROKEN=broken)
        expect(f"{broken} fails", (status, (build / "packages").exists()), (1, False))
        expect(f"{broken} fails: the message", "libopenmesh-dev could not be fetched and unpacked" in output, True)
    expect("after failures", system.run("unpack_openmesh")[0], 0)
    expect("after failures: what is in build", [path.name for path in build.iterdir()], ["packages"])


def unpacks_proxies_once(system):
    tree = system.root / "build/proxies"
    (system.root / "build").mkdir()
    expect("proxies installed", system.run("unpack_proxies", INSTALLED="nginx caddy"), (0, "", []))
    status, _, calls = system.run("unpack_proxies", INSTALLED="nginx")
    expect("one missing", (status, calls, (tree / "usr/caddy").exists()), (0, [DOWNLOADED + "caddy"], True))
    expect("the second time", system.run("unpack_proxies"), (0, "", []))


def goes_on_without_proxies(system):
    build = system.root / "build"
    build.mkdir()
    for broken in ("-qq", "caddy.deb"):  # apt-get's download and update; the first archive
        status, output, calls = system.run("unpack_proxies; echo on", BROKEN=broken)
        expect(f"{broken} fails", (status, (build / "proxies").exists(), calls[:2]), (0, False, [DOWNLOADED + "nginx caddy", UPDATE]))
        expect(f"{broken} fails: the message", "nginx caddy could not be fetched and unpacked (see above); their tests are skipped" in output, True)
        expect(f"{broken} fails: the rest goes on", "\non\n" in output, True)
    expect("after failures", system.run("unpack_proxies")[2], [DOWNLOADED + "nginx caddy"])
    expect("after failures: what is in build", [path.name for path in build.iterdir()], ["proxies"])


def readme_gives_every_reason(system):
    _, output, _ = system.run('printf "%s\\n" "${product_packages[@]}" "${test_packages[@]}" nodejs npm "$openmesh" "${proxies[@]}"')
    listed = {name.split("|")[0] for name in output.split()}
    rows = re.findall(r"^\| ((?:`[^`]+`,? ?)+)\|", (TOP / "deploy/README.md").read_text(encoding="utf-8"), re.MULTILINE)
    told = {name for row in rows for name in re.findall(r"`([^`]+)`", row) if not name.endswith("/")}
    expect("packages without a reason in deploy/README.md", listed - told, set())
    expect("packages in deploy/README.md that set-up does not install", told - listed, set())


checks = [installs_what_is_missing, removes_nothing, names_what_failed, unpacks_openmesh_once, unpacks_openmesh_whole_or_not,
          unpacks_proxies_once, goes_on_without_proxies, readme_gives_every_reason]
for check in checks:
    each(check)
print(f"{len(checks)} checks, {failures} failures")
sys.exit(1 if failures else 0)
