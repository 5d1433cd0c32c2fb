"""Holds the tables of protocol/SPEC.md against the data they are made from, and the packed tables against their SHA-256."""

import hashlib
import json
import re
import sys

from stream_reader import PACKED, PROTOCOL, SPEC, table

DATA = PROTOCOL.parent / "core/tables/data"
FAPS = json.loads((DATA / "faps.json").read_text())["faps"]
POINTS = json.loads((DATA / "feature-points.json").read_text())["feature_points"]
failures = checks = 0


def same(read, expected, what):
    global failures, checks
    checks += 1
    if read != expected:
        failures += 1
        print(f"FAILED: {what}: {read}, not {expected}")


def motion(fap):
    """A unit vector along an axis as the document writes it."""
    if "axis" not in fap or fap["axis"] is None:
        return {"high_level": "set", "scale": "pupil", "rotation": "roll"}[fap["kind"]]
    axis = next(i for i in range(3) if fap["axis"][i])
    return ("turn " if fap["kind"] == "rotation" else "") + "-+"[fap["axis"][axis] > 0] + "xyz"[axis]


rows = table("faps")
same(len(rows), len(FAPS), "number of FAPs")
for row, fap in zip(rows, FAPS):
    expected = [str(fap["number"]), f"`{fap['name']}`", str(fap["group"]), ", ".join(fap.get("feature_points", []))]
    expected += [motion(fap), "", "", "", "", fap["description"]]
    if fap["kind"] != "high_level":
        least, most = (level * fap["quantizer_step"] for level in fap["levels"])
        expected[5] = fap["unit"]
        expected[6] = {"B": "two", "U": "one"}[fap["directionality"]]
        expected[7:9] = str(fap["quantizer_step"]), f"{least} to {most}"
    same(row, expected, f"FAP {fap['number']}")

rows = table("feature points")
same(len(rows), len(POINTS), "number of FPs")
for index, (row, point) in enumerate(zip(rows, POINTS)):
    faps = ", ".join(str(f["number"]) for f in FAPS if point["id"] in f.get("feature_points", []))
    side = point["side"].replace("center", "middle")
    same(row, [str(index), point["id"], side, point["mirror"], faps, point["name"]], f"FP {point['id']}")

first = 0
for group, ids, count, indices in table("feature point groups"):
    members = [p["id"] for p in POINTS if p["id"].split(".")[0] == group]
    last = first + len(members) - 1
    same(int(count), len(members), f"FP group {group}")
    same(ids, f"{members[0]} to {members[-1]}" if last > first else members[0], f"FPs of group {group}")
    same(indices, f"{first} to {last}" if last > first else str(first), f"indices of group {group}")
    first = last + 1
same(first, len(POINTS), "FPs of all groups together")

# The form of a packed stream depends on every one of these values: where this fails, the change needs another coding.
file = (PROTOCOL / "schema/packed_tables.json").read_bytes()
size, sha256 = re.search(r"UTF-8 JSON, (\d+) bytes, with the SHA-256 `([0-9a-f]{64})`", SPEC).groups()
same(len(file), int(size), "bytes of packed_tables.json")
same(hashlib.sha256(file).hexdigest(), sha256, "SHA-256 of packed_tables.json")
same([[f"`{t['name']}`", str(len(t["values"]))] for t in PACKED["tables"]],
     [row[:2] for row in table("packed tables")], "packed tables")

print(f"{checks} checks, {failures} failed")
sys.exit(1 if failures or checks < 180 else 0)
