"""links_test.py finds each kind of fault: a small tree and a text with one fault at a time."""

from checker import end, tree
from links_test import check

TREE = {"a/b.md": "# The b\n\n## Build, install, use `it`\n\n## Twice\n\n## Twice\n", "a/c.h": "", "server/api/openapi.json": '{"paths": {"/v1/models": {}, "/v1/models/{model}/mesh.drc": {}}}'}
CASES = [  # text, what the message must say
    ("[b](a/b.md) [c](a/c.h) [a](a/) ![p](a/c.h) [x](https://x.test/y) [m](mailto:a@b.test)", None),
    ("# Here\n[x](#here) [y](a/b.md#build-install-use-it) [z](a/b.md#twice) [z](a/b.md#twice-1)", None),
    ("`[x](gone.md)`\n```\n[x](gone.md)\n# Gone\n```\n", None),
    ("\n[x](gone.md)", "README.md:2: the link gone.md leads nowhere"),
    ("[x](a/b.md#gone)", "the link a/b.md#gone names no heading of b.md"),
    ("[x](a/b.md#twice-2)", "names no heading"),
    ("```\n# Gone\n```\n[x](#gone)", "README.md:4: the link #gone names no heading of README.md"),
    ("`GET /v1/models/{id}/mesh.drc`, http://127.0.0.1:8080/v1/models. vectors/v1/text.json, and `$api/models/$id/mesh.drc?lod=1`", None),
    ("It has\n`GET /v1/models/{id}/skinned.glb`.", "README.md:2: /v1/models/{id}/skinned.glb is no route of server/api/openapi.json"),
    ('    curl "$api/model/$id/mesh.drc"', "$api/model/$id/mesh.drc is no route"),
]
failures = 0
for text, message in CASES:
    with tree({**TREE, "README.md": text, "node_modules/x/README.md": "[x](gone)"}) as top:
        faults = check(top)[0]
    if faults != [] if message is None else len(faults) != 1 or message not in faults[0]:
        failures += 1
        print(f"FAILED: {text!r} gives {faults}, not {message!r}")
end(len(CASES), failures)
