"""Holds every #include and TypeScript import against the tables "may depend on" of the READMEs.

A room is a folder that a row of such a table names (`folder` is relative to the README); a file belongs to the longest room
that its path begins with. The names in backticks before the first semicolon of the column "may depend on" are the rooms or
files that it may depend on, relative to the README or to the top of the tree; what follows the semicolon is for people.
A table is also wrong where it allows what nothing uses. No rooms may depend on each other in a circle. Python 3, standard library.

    layers_test.py [TOP_OF_THE_TREE]"""

import os
import pathlib
import posixpath
import re

from checker import run

# What each top folder may name at all. The order of the READMEs' tables cannot turn an arrow round.
ARROWS = {
    "core": ["core"],
    "protocol": ["core", "protocol"],
    "server": ["core", "protocol", "server"],
    "clients": ["core", "protocol", "clients"],
    "deploy": ["core", "deploy"],
    "web": ["protocol", "clients", "web"],
}
ALIASES = {"@protocol/": "protocol/ts/", "@client/": "clients/js/", "semblante/": "clients/js/"}  # web/aliases.ts
NOT_ROOMS = ("web/test/", "web/node_modules/", "web/dist/")  # tests depend on everything
COLUMN = "may depend on"

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*"([^"\n]+)"', re.M)
IMPORT = re.compile(
    r"""^(?:import|export)\b[^;'"]*?\bfrom\s*['"]([^'"\n]+)['"]|^import\s*['"]([^'"\n]+)['"]|\bimport\(\s*['"]([^'"\n]+)['"]""",
    re.M,
)
RAW_STRING = re.compile(r'R"(\w*)\(.*?\)\1"', re.S)
NAME = re.compile(r"`([^`]+)`")


def below(path, folder):
    return path == folder or path.startswith(folder + "/")


def sources(top):
    for layer in ARROWS:
        for folder, folders, names in os.walk(top / layer):
            at = pathlib.Path(folder).relative_to(top).as_posix()
            folders[:] = sorted(f for f in folders if not (at + "/" + f + "/").startswith(NOT_ROOMS))
            yield from (f"{at}/{name}" for name in sorted(names))


def named_file(top, source, name):
    """The file of ours, from the top of the tree, that an include or import names; None for a library's."""
    for alias, folder in ALIASES.items():
        if name.startswith(alias):
            return posixpath.normpath(folder + name[len(alias):])
    beside = posixpath.normpath(posixpath.join(posixpath.dirname(source), name))
    if source.endswith(".ts"):
        return beside if name.startswith(".") else None
    return next((path for path in (name, beside) if (top / path).is_file()), None)


def references(top, source):
    """(line, what is written there, file that it names), of a source file."""
    text = (top / source).read_text(encoding="utf-8")
    if source.endswith(".ts"):
        found = [(m, m.group(m.lastindex)) for m in IMPORT.finditer(text)]
    else:
        # An include within a raw string is one of a file that is generated. Lines keep their numbers.
        text = RAW_STRING.sub(lambda m: "\n" * m.group().count("\n"), text)
        found = [(m, m.group(1)) for m in INCLUDE.finditer(text)]
    for match, name in found:
        target = named_file(top, source, name)
        if target is not None:
            yield text.count("\n", 0, match.start()) + 1, name, target


class Row:
    """A row of a table: the rooms it names, the paths they may depend on, and where it stands."""

    def __init__(self, rooms, allowed, where):
        self.rooms, self.allowed, self.where, self.used = rooms, allowed, where, set()

    def allows(self, target):
        fitting = {path for path in self.allowed if below(target, path)}
        self.used |= fitting
        return bool(fitting)


def rows_of(top, readme, faults):
    """The rows of a README's tables that say what rooms may depend on."""
    folder, column = posixpath.dirname(readme), None
    for number, line in enumerate((top / readme).read_text(encoding="utf-8").split("\n"), 1):
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")] if line.startswith("|") else []
        if COLUMN in cells:
            column = cells.index(COLUMN)
        elif not cells:
            column = None
        elif column is not None and not line.startswith("|---"):
            where, allowed = f"{readme}:{number}", {}
            for name in NAME.findall(cells[column].split(";")[0]):
                path = next((p for p in (posixpath.join(folder, name), name) if (top / p).exists()), None)
                if path is None:
                    faults.append(f"{where}: there is no {name}")
                else:
                    allowed[posixpath.normpath(path)] = name
            row = Row([posixpath.normpath(posixpath.join(folder, name)) for name in NAME.findall(cells[0])], allowed, where)
            faults += [f"{where}: there is no {name}" for name in row.rooms if not (top / name).exists()]
            yield row


def circle(edges):
    """Rooms that depend on each other in a circle, the first again at the end; empty where there is none."""
    done = set()

    def visit(room, path):
        if room in path:
            return path[path.index(room):] + [room]
        if room not in done:
            for other in sorted(edges.get(room, ())):
                found = visit(other, path + [room])
                if found:
                    return found
            done.add(room)
        return []

    return next(filter(None, (visit(room, []) for room in sorted(edges))), [])


def check(top):
    """(faults, number of references, number of rooms) of the tree."""
    faults, rows, room_of_folder, edges = [], [], {}, {}
    files = list(sources(top))
    for readme in (f for f in files if f.endswith("/README.md")):
        for row in rows_of(top, readme, faults):
            rows.append(row)
            for name in row.rooms:
                if name in room_of_folder:
                    faults.append(f"{row.where}: {name} has a row in {room_of_folder[name].where} already")
                room_of_folder[name] = row

    def room(path):
        return max((name for name in room_of_folder if below(path, name)), key=len, default=None)

    seen = 0
    for source in files:
        layer = source.split("/")[0]
        if not source.endswith((".h", ".c", ".cpp", ".ts")) or source.startswith("web/") and source.count("/") == 1:
            continue  # what lies in web/ itself configures its tools
        own = room(source)
        if own is None:
            faults.append(f"{source}: belongs to no room; add its folder to the table in {layer}/README.md")
            continue
        for line, name, target in references(top, source):
            seen += 1
            row, other = room_of_folder[own], room(target) or posixpath.dirname(target)
            if target.split("/")[0] not in ARROWS[layer]:
                faults.append(f"{source}:{line}: names \"{name}\": {layer}/ may depend on {', '.join(ARROWS[layer])} alone, "
                              f"whatever {row.where} says")
                continue
            if other == own:
                continue
            edges.setdefault(own, set()).add(other)
            if not row.allows(target):
                faults.append(f"{source}:{line}: names \"{name}\", but {own} may not depend on {other}: see {row.where}")
    for row in rows:
        for path in sorted(set(row.allowed) - row.used):
            faults.append(f"{row.where}: nothing in {', '.join(row.rooms)} depends on {row.allowed[path]}: take it away")
    if circle(edges):
        faults.append(f"rooms depend on each other in a circle: {' -> '.join(circle(edges))}")
    return faults, seen, len(room_of_folder)


if __name__ == "__main__":
    run(check, {"includes and imports of ours": 1000, "rooms": 40})
