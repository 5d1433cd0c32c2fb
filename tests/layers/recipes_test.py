"""Holds the recipes of .github/CONTRIBUTING.md and the READMEs that follow data hop by hop against the tree.

In these texts a name in backticks that has a slash or ends like a source file is a path, relative to the README or to the top
of the tree; it must exist. `path`, `name` (with a comma between) says that the file contains that name: a function, or a test
written as Suite.Case. Names with NAME or * stand for something that is to be added: their folder
must exist. A relative link must lead somewhere. Python 3, standard library.

    recipes_test.py [TOP_OF_THE_TREE]"""

import posixpath
import re

from checker import run

# Text, and the folder besides the top of the tree that its paths are relative to.
TEXTS = {
    ".github/CONTRIBUTING.md": "",
    "core/pipeline/README.md": "core/pipeline",
    "server/settings/README.md": "server/settings",
    "server/streams/README.md": "server/streams",
    "web/src/view/README.md": "web/src/view",
}
ENDINGS = (".cpp", ".h", ".c", ".ts", ".mjs", ".json", ".py", ".md", ".txt", ".sh", ".cmake")
MADE = ("build/", "web/dist/")  # by the build
PUBLISHED = ("rig.json", "report.json")  # names of artefacts, not of files of ours

NAME = re.compile(r"`([^`\s]+)`")
FOUND_IN = re.compile(r"`([^`\s]+)`,\s+(?:in\s+)?`([A-Za-z_][\w.]*)(?:\(\))?`")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")


def is_path(name):
    return not name.startswith(("/", "-", "http", "--")) and (name.endswith(ENDINGS) or "/" in name) and "{" not in name


def find(top, folder, name):
    """The file or folder of a name; None where there is none. `net/outbox.cpp` of server/streams is server/net/outbox.cpp."""
    for base in (folder, posixpath.dirname(folder), ""):
        path = top / base / name
        if path.exists():
            return path
    return None


def is_test(name):
    return re.fullmatch(r"[A-Z]\w*\.[A-Z]\w*", name) is not None


def contains(text, name):
    if is_test(name):
        suite, case = name.split(".")
        return re.search(rf"TEST(?:_F|_P)?\({suite}, {case}\b", text) is not None
    return re.search(rf"\b{re.escape(name)}\b", text) is not None


def check(top, texts=TEXTS):
    faults, paths, names = [], 0, 0
    for readme, folder in texts.items():
        text = (top / readme).read_text(encoding="utf-8")
        line = lambda match: f"{readme}:{text.count(chr(10), 0, match.start()) + 1}"
        for match in NAME.finditer(text):
            name = match.group(1)
            if not is_path(name) or name.startswith(MADE) or name in PUBLISHED:
                continue
            paths += 1
            if "NAME" in name or "*" in name:
                name = posixpath.dirname(name.split("NAME")[0].split("*")[0] + "x") or "."
            if find(top, folder, name) is None:
                faults.append(f"{line(match)}: there is no {name}")
        for match in FOUND_IN.finditer(text):
            file, name = match.groups()
            path = find(top, folder, file) if is_path(file) and "NAME" not in file else None
            if path is None or not path.is_file() or is_path(name):
                continue
            names += 1
            if not contains(path.read_text(encoding="utf-8"), name):
                faults.append(f"{line(match)}: {file} does not contain {name}")
        for match in LINK.finditer(text):
            target = match.group(1)
            if ":" not in target and not (top / posixpath.dirname(readme) / target).exists():
                faults.append(f"{line(match)}: the link {target} leads nowhere")
    return faults, paths, names


if __name__ == "__main__":
    run(check, {"paths": 100, "names within files": 40})
