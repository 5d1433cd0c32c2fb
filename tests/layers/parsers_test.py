"""Every reader of outside bytes has a fuzz target, and every fuzz target has seeds.

A reader is a function of a header in core, protocol, clients or server that makes a Result from text or bytes, and is called
read_, parse_, decode_ or converted_ something, or something _from_json or _size. It is reached by a target that names it, by one of
REACHED, or does not read outside bytes for a reason of INSIDE. Python 3, standard library.

    parsers_test.py [TOP_OF_THE_TREE]"""

import re

from checker import run

# Readers that no target names: the target that reaches them through others.
REACHED = {
    "decode_data_uri": "gltf",
    "decode_image": "image",
    "decode_meshopt": "glb",
    "decode_mesh": "runtime_head",
    "displacements_from_json": "displacement_set",
    "converted_webp": "image",
    "parse_ply_header": "ply",
    "read_chunk_head": "recording",
    "read_frames_chunk": "recording",
    "read_fap_faces": "protocol_fap_file",
    "read_frames_faces": "protocol_json",
    "read_glb": "glb",
    "read_gltf": "gltf",
    "read_gltf_zip": "gltf_zip",
    "read_header_chunk": "recording",
    "read_live_link_faces": "live_link_csv",
    "read_obj": "obj",
    "read_packed_keyframe": "protocol_messages",
    "read_performance_faces": "performance",
    "read_ply": "ply",
    "read_recording_faces": "recording",
    "read_sound_chunk": "recording",
    "read_stl": "stl",
    "read_xml_tag": "marked_ssml",
    "webp_size": "image",
}
INSIDE = {
    "parse_endpoint": "an option of a command line",
    "parse_shot": "an option of a command line",
    "parse_size": "an option of a command line",
    "parse_url": "an option of a command line",
}

READER = re.compile(r"\bResult<[^;{}()]*?>\s+(\w+)\(\s*(?:const\s+)?(?:std::string_view|std::span<const std::uint8_t>|std::string ?&|"
                    r"nlohmann::json ?&|std::vector<std::uint8_t>)")
NAMED = re.compile(r"(read|parse|decode|converted)_\w+$|\w+_(from_json|size)$")
TARGETS = re.compile(r"foreach\((\w+) ([^)]*)\)|endforeach\(\)|semblante_fuzz\(([\w${}]+)")


def targets_of(text):
    """The names of the fuzz targets of a CMakeLists.txt, those of loops too."""
    names, variable, values = [], None, []
    for loop, items, name in TARGETS.findall(text):
        if loop:
            variable, values = loop, items.split()
        elif not name:
            variable = None
        elif variable and "${" in name:
            names += [name.replace("${" + variable + "}", value) for value in values]
        else:
            names.append(name)
    return names


def check(top, reached=None, inside=None):
    """(faults, number of readers, number of fuzz targets)."""
    reached, inside = REACHED if reached is None else reached, INSIDE if inside is None else inside
    faults = []
    fuzz = top / "tests/fuzz"
    targets = {name for file in fuzz.rglob("CMakeLists.txt") for name in targets_of(file.read_text(encoding="utf-8"))}
    sources = "\n".join(file.read_text(encoding="utf-8") for ending in ("*.cpp", "*.h") for file in fuzz.rglob(ending))
    words = set(re.findall(r"\w+", sources))
    readers = {}
    for folder in ("core", "protocol", "clients", "server"):
        for file in sorted((top / folder).rglob("*.h")):
            for name in READER.findall(file.read_text(encoding="utf-8")):
                if NAMED.match(name):
                    readers.setdefault(name, file.relative_to(top))
    for name, file in sorted(readers.items()):
        if name not in words and name not in reached and name not in inside:
            faults.append(f"{file}: {name} reads outside bytes, and no fuzz target of tests/fuzz names it")
    for name, target in sorted(reached.items()):
        if name not in readers:
            faults.append(f"parsers_test.py: there is no reader {name}")
        if target not in targets:
            faults.append(f"parsers_test.py: there is no fuzz target {target}, which is to reach {name}")
    faults += [f"parsers_test.py: there is no reader {name}" for name in sorted(inside) if name not in readers]
    seeds = {folder.name for folder in (fuzz / "seeds").iterdir() if any(folder.iterdir())}
    faults += [f"tests/fuzz/seeds/{name}: the fuzz target has no seeds" for name in sorted(targets - seeds)]
    faults += [f"tests/fuzz/seeds/{name}: there is no such fuzz target" for name in sorted(seeds - targets)]
    return faults, len(readers), len(targets)


if __name__ == "__main__":
    run(check, {"readers": 40, "fuzz targets": 40})
