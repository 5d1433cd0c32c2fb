"""What the checkers of this folder and their tests have in common."""

import contextlib
import pathlib
import sys
import tempfile


def run(check, least):
    """The end of a checker: calls check(top) and exits. `top` is the argument, otherwise the top of this tree. check returns the
    faults, then one count for each row of `least`, {what is counted: how many there are at least}: a checker that finds far
    less than there is does not work."""
    top = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).resolve().parents[2])
    faults, *counts = check(top)
    for fault in faults:
        print("FAILED:", fault)
    print(", ".join(f"{count} {what}" for what, count in zip(least, counts)) + f", {len(faults)} faults")
    sys.exit(1 if faults or any(count < bound for count, bound in zip(counts, least.values())) else 0)


@contextlib.contextmanager
def tree(files):
    """A folder with these files, {path: text}."""
    with tempfile.TemporaryDirectory() as top:
        for name, text in files.items():
            path = pathlib.Path(top, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        yield pathlib.Path(top)


def end(cases, failures):
    """The end of a checker's test."""
    print(f"{cases} cases, {failures} failed")
    sys.exit(1 if failures else 0)
