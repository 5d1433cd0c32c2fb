"""layers_test.py finds each kind of fault: a small tree with one fault at a time."""

from checker import end, tree
from layers_test import check

TABLE = "| folder | what | may depend on |\n|---|---|---|\n"
SOUND = {
    "core/README.md": TABLE + "| `a` | | nothing; GLM |\n| `b` | | `a` |\n",
    "core/a/a.h": "#include <vector>\n",
    "core/b/b.cpp": '#include "core/a/a.h"\n',
    "protocol/README.md": TABLE + "| `ts/` | | nothing |\n",
    "protocol/ts/index.ts": "import { x } from './other.ts';\n",
    "protocol/ts/other.ts": "export const x = 1;\n",
    "web/README.md": TABLE + "| `src/face` | | `protocol/ts` |\n| `src/view` | | `src/face` |\n",
    "web/src/face/face.ts": "import {\n  x,\n} from '@protocol/index.ts';\n",
    "web/src/view/view.ts": "import type { Face } from '../face/face.ts';\nimport * as three from 'three';\n",
}
FAULTS = [  # what is added or replaced, what the message must say
    ({}, []),
    ({"core/a/a.h": '\n#include "core/b/b.h"\n', "core/b/b.h": ""},
     ["core/a/a.h:2:", "core/b/b.h", "core/a may not depend on core/b", "core/README.md:3"]),
    ({"core/a/more.c": '#include "../b/b.h"\n', "core/b/b.h": ""}, ["core/a/more.c:1:", "core/README.md:3"]),
    ({"core/b/b.cpp": '#include "core/a/a.h"\n#include "protocol/x.h"\n', "protocol/x.h": ""},
     ["core/b/b.cpp:2:", "core/ may depend on core alone", "core/README.md:4"]),
    ({"web/src/view/view.ts": "import '../face/face.ts';\nimport { x } from '@protocol/index.ts';\n"},
     ["web/src/view/view.ts:2:", "web/src/view may not depend on protocol/ts", "web/README.md:4"]),
    ({"web/src/view/later.ts": "const x = await import('@protocol/index.ts');\n"}, ["web/src/view/later.ts:1:"]),
    ({"core/b/b.cpp": ""}, ["core/README.md:4", "nothing in core/b depends on a"]),
    ({"core/b/b.cpp": '#include "core/a/a.h"\nconst char* text = R"(\n#include "core/b/b.h"\n)";\n'}, []),
    ({"core/README.md": TABLE + "| `a` | | |\n| `b` | | `a`, `gone` |\n"}, ["core/README.md:4", "there is no gone"]),
    ({"core/README.md": TABLE + "| `a` | | |\n| `b` | | `a` |\n| `c` | | |\n"}, ["core/README.md:5", "there is no core/c"]),
    ({"core/README.md": TABLE + "| `a` | | |\n| `b` | | `a` |\n| `a` | | |\n"}, ["core/README.md:5", "core/README.md:3"]),
    ({"core/c/c.h": ""}, ["core/c/c.h: belongs to no room"]),
    ({"core/README.md": TABLE + "| `a` | | `b` |\n| `b` | | `a` |\n", "core/a/a.h": '#include "core/b/b.h"\n', "core/b/b.h": ""},
     ["core/a -> core/b -> core/a"]),
]
failures = 0
for changes, words in FAULTS:
    with tree({**SOUND, **changes}) as top:
        faults = check(top)[0]
    found = all(any(word in fault for fault in faults) for word in words) and bool(faults) == bool(words)
    if not found:
        failures += 1
        print(f"FAILED: {changes}: {faults}, not {words}")
end(len(FAULTS), failures)
