"""Holds the independent reader against every stream message in protocol/vectors/v1."""

import json
import sys

from stream_reader import PROTOCOL, STANDARD_STEPS, Reader, Refused, opus_packet_ms, score_steps

FOLDER = PROTOCOL / "vectors/v1"
failures = checks = 0


def check(holds, what):
    global failures, checks
    checks += 1
    if not holds:
        failures += 1
        print("FAILED:", what)


def vectors(name):
    return json.loads((FOLDER / name).read_text())


def same(reader, as_json, message, name):
    try:
        read = reader.binary(bytes.fromhex(message["binary"]))
        as_json.steps = reader.steps
        check(read == as_json.document(message["json"]), f"{name}: {read}")
        return read
    except Refused as refused:
        check(False, f"{name}: {refused}")


def refuses(read, case):
    try:
        read()
        check(False, f"{case['name']}: was taken")
    except Refused as refused:
        check((refused.code, refused.where) == (case["code"], case["where"]), f"{case['name']}: {refused}")


reader, as_json = Reader(), Reader()
for message in vectors("messages.json")["messages"]:
    same(reader, as_json, message, message["name"])
    if message["name"].startswith("header with the standard steps"):
        check(reader.steps == STANDARD_STEPS, f"{message['name']}: {reader.steps}")

appended = vectors("appended_fields.json")
named = {}
for message in appended["messages"]:
    named[message["name"]] = same(Reader(), Reader(), message, message["name"])
others = [{"as": "header with the standard steps", "binary": appended["reads_as_absent"]}] + appended["reads_as_default"]
for other in others:
    check(Reader().binary(bytes.fromhex(other["binary"])) == named[other["as"]], f"{other['binary']} as {other['as']}")

sound = vectors("sound.json")
reader, as_json = Reader(), Reader()
for message in sound["messages"]:
    read = same(reader, as_json, message, message["name"])
    if read["type"] == "sound":
        check(opus_packet_ms(read["packet"]) == message["lasts"], message["name"])

spoken = vectors("text.json")
reader, as_json = Reader(), Reader()
for message in spoken["messages"]:
    read = same(reader, as_json, message, message["name"])
    if read["type"] == "text":
        check(score_steps(read["score"]) == [tuple(step) for step in message["steps"]], message["name"])

packed = vectors("packed_text.json")
for message in packed["messages"]:
    same(reader, as_json, message, message["name"])

for case in vectors("refused.json")["refused"] + sound["refused"] + spoken["refused"] + packed["refused"]:
    reader = Reader()
    reader.binary(bytes.fromhex("090000e3"))
    if "binary" in case:
        refuses(lambda: reader.binary(bytes.fromhex(case["binary"])), case)
        following = reader.binary(bytes.fromhex("81a2"))
        check(following["sequence"] == 1, f"{case['name']}: changed the state")
    else:
        refuses(lambda: reader.text(case["json"]), case)

for stream in vectors("packed.json")["streams"]:
    messages = stream["messages"]
    joins = [i for i, message in enumerate(messages) if message["json"]["type"] == "keyframe"]
    check(joins[:1] == [0], f"{stream['name']}: begins with a keyframe")
    for join in joins:
        reader, as_json = Reader(), Reader()
        for i in range(join, len(messages)):
            # Whoever reads on does not need the later keyframes, and they are no break for who reads them.
            same(reader, as_json, messages[i], f"{stream['name']}, message {i} of who joined at {join}")
        reader = Reader()
        for i in range(join, len(messages)):
            if i == join or i not in joins:
                same(reader, Reader(), messages[i], f"{stream['name']}, batch {i} of who joined at {join}")

for case in vectors("packed_refused.json")["refused"]:
    reader = Reader()
    for before in case["before"]:
        reader.binary(bytes.fromhex(before))
    state = reader.packed and dict(reader.packed.__dict__)
    refuses(lambda: reader.binary(bytes.fromhex(case["binary"])), case)
    check((reader.packed and dict(reader.packed.__dict__)) == state, f"{case['name']}: changed the state")

print(f"{checks} checks, {failures} failed")
sys.exit(1 if failures or checks < 200 else 0)
