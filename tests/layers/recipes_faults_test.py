"""recipes_test.py finds each kind of fault: a small tree and a text with one fault at a time."""

from checker import end, tree
from recipes_test import check

TREE = {
    "core/a/a.h": "Result<Head> make_head(int bytes);\n",
    "core/b/b.cpp": "",
    "tests/a_test.cpp": "TEST(Heads, MadeOfBytes) {}\n",
}
CASES = [  # text, what the message must say
    ("1. `core/a/a.h`, `make_head`: `b/b.cpp`, `a.h`, [b](../b/b.cpp), `tests/a_test.cpp`, `Heads.MadeOfBytes`.", None),
    ("`ninja -C build x/y.o`, `--out`, `/v1/models`, `build/bin/x`, `rig.json`, `std::variant`, [x](https://x.test/y)", None),
    ("`core/a/NAME_job.h`, `core/a/*.h`, `NAME_job.h`", None),
    ("\n`core/a/gone.h`", "core/a/README.md:2: there is no core/a/gone.h"),
    ("`core/gone/NAME_job.h`", "there is no core/gone"),
    ("`core/a/a.h`, `make`", "core/a/a.h does not contain make"),
    ("`core/a/a.h`,\n   `made_head`", "core/a/a.h does not contain made_head"),
    ("`tests/a_test.cpp`, `Heads.Gone`", "tests/a_test.cpp does not contain Heads.Gone"),
    ("`tests/a_test.cpp`, `Heads.MadeOf`", "tests/a_test.cpp does not contain Heads.MadeOf"),
    ("[b](b.cpp)", "the link b.cpp leads nowhere"),
]
failures = 0
for text, message in CASES:
    with tree({**TREE, "core/a/README.md": text}) as top:
        faults = check(top, {"core/a/README.md": "core/a"})[0]
    if faults != [] if message is None else len(faults) != 1 or message not in faults[0]:
        failures += 1
        print(f"FAILED: {text!r} gives {faults}, not {message!r}")
end(len(CASES), failures)
