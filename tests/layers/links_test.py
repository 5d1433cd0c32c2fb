"""Every relative link of every Markdown file of the tree leads to a file or folder, and with a # to a heading of that file; every
address /v1/... that such a file names, also behind the variable $api of its examples, is a route of the interface.

    links_test.py [TOP_OF_THE_TREE]"""

import json
import os
import pathlib
import re

from checker import run

NO_TEXTS = {"build", "node_modules", "dist", "data"}
CODE = re.compile(r"```.*?```|`[^`\n]*`", re.DOTALL)
FENCED = re.compile(r"```.*?```", re.DOTALL)
LINK = re.compile(r"\]\(([^)\s]+)\)")
ADDRESS = re.compile(r"(?<![\w./-])(?:(?:https?|wss?)://[\w.:-]+)?(?:\$api|/v1)((?:/[\w.-]+|/\$?\{\w+\}|/\$\w+)+)(?<!\.)")
ROUTES = "server/api/openapi.json"
HEADING = re.compile(r"^#+ +(.+?) *$", re.MULTILINE)


def texts(top):
    for folder, folders, names in os.walk(top):
        folders[:] = sorted(name for name in folders if name not in NO_TEXTS and (name == ".github" or not name.startswith(".")))
        yield from (pathlib.Path(folder, name) for name in sorted(names) if name.endswith(".md"))


def anchors(text):
    """What GitHub makes of the headings; a heading that occurs again gets a number."""
    found = {}
    for heading in HEADING.findall(FENCED.sub("", text)):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
        anchor = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
        found[anchor] = found.get(anchor, -1) + 1
    return {anchor if n == 0 else f"{anchor}-{n}" for anchor, most in found.items() for n in range(most + 1)}


def routes(top):
    """The paths of the interface as expressions; a parameter stands for any one part."""
    file = pathlib.Path(top, ROUTES)
    if not file.exists():
        return None
    made = []
    for path in json.loads(file.read_text())["paths"]:
        parts = ["[^/]+" if part.startswith("{") else re.escape(part) for part in path.split("/")]
        made.append("/".join(parts))
    return re.compile("|".join(made))


def check(top):
    faults, links, addresses = [], 0, 0
    known = routes(top)
    for path in texts(top):
        name = path.relative_to(top)
        text = path.read_text()
        blanked = CODE.sub(lambda code: re.sub(r"[^\n]", " ", code.group()), text)  # line numbers stay
        for match in LINK.finditer(blanked):
            link = match.group(1)
            if re.match(r"[a-z]+:", link):
                continue
            links += 1
            place = f"{name}:{blanked[:match.start()].count(chr(10)) + 1}"
            file, _, anchor = link.partition("#")
            target = path.parent / file if file else path
            if not target.exists():
                faults.append(f"{place}: the link {link} leads nowhere")
            elif anchor and target.suffix == ".md" and anchor not in anchors(target.read_text()):
                faults.append(f"{place}: the link {link} names no heading of {target.name}")
        for match in ADDRESS.finditer(text) if known else ():
            addresses += 1
            if not known.fullmatch("/v1" + match.group(1)):
                faults.append(f"{name}:{text[:match.start()].count(chr(10)) + 1}: {match.group()} is no route of {ROUTES}")
    return faults, links, addresses


if __name__ == "__main__":
    run(check, {"links": 150, "addresses": 100})
