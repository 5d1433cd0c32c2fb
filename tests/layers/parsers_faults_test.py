"""parsers_test.py finds each kind of fault: a small tree with one fault at a time."""

from checker import end, tree
from parsers_test import check

TREE = {
    "core/a/a.h": "Result<Head> read_head(std::string_view text);\nResult<int> count(std::string_view text);\n",
    "protocol/p.h": "Result<std::vector<int>> inner_from_json(const nlohmann::json& object);\n",
    "clients/c.h": "[[nodiscard]] Result<Url> parse_word(const std::string& text);\n",
    "server/s.h": "Result<int> decode_number(int number);\n",
    "tests/fuzz/a/CMakeLists.txt": "foreach(name x y)\n  semblante_fuzz(a_${name} SOURCES a.cpp)\nendforeach()\nsemblante_fuzz(b SOURCES b.cpp)\n",
    "tests/fuzz/a/a.cpp": "auto head = read_head(text);\n",
    "tests/fuzz/seeds/a_x/seed": "",
    "tests/fuzz/seeds/a_y/seed": "",
    "tests/fuzz/seeds/b/seed": "",
}
REACHED, INSIDE = {"inner_from_json": "b"}, {"parse_word": "an option"}
CASES = [  # what differs in the tree, in the lists; what the message must say
    ({}, {}, {}, None),
    ({"tests/fuzz/a/a.cpp": "read_heads(text)"}, {}, {}, "core/a/a.h: read_head reads outside bytes"),
    ({"server/s.h": "Result<int>\n    decode_number(std::span<const std::uint8_t> bytes);"}, {}, {}, "server/s.h: decode_number reads"),
    ({}, {"read_gone": "b"}, {}, "there is no reader read_gone"),
    ({}, {"inner_from_json": "c"}, {}, "there is no fuzz target c, which is to reach inner_from_json"),
    ({}, {}, {"parse_gone": "x"}, "there is no reader parse_gone"),
    ({"tests/fuzz/a/CMakeLists.txt": TREE["tests/fuzz/a/CMakeLists.txt"] + "semblante_fuzz(d SOURCES d.cpp)\n"}, {}, {}, "seeds/d: the fuzz target has no seeds"),
    ({"tests/fuzz/seeds/old/seed": ""}, {}, {}, "seeds/old: there is no such fuzz target"),
]
failures = 0
for files, reached, inside, message in CASES:
    with tree({**TREE, **files}) as top:
        faults = check(top, {**REACHED, **reached}, {**INSIDE, **inside})[0]
    if faults != [] if message is None else len(faults) != 1 or message not in faults[0]:
        failures += 1
        print(f"FAILED: {files, reached, inside} gives {faults}, not {message!r}")
end(len(CASES), failures)
