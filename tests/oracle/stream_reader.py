"""Reads the messages of a Semblante stream: JSON and binary.

Written from protocol/SPEC.md and the JSON files it names, alone, to hold the document against the server: what is not said
there is not to be taken from the C++ or TypeScript but to be said there. Slow and literal; Python 3, standard library.

A message is a dict as its JSON form, but that each state is a Face (levels, not FAP units) and each frame (time, Face)."""

import base64
import binascii
import json
import pathlib
import re
import struct
from collections import namedtuple

PROTOCOL = pathlib.Path(__file__).resolve().parents[2] / "protocol"
SCHEMA = json.loads((PROTOCOL / "schema/messages.json").read_text())
PACKED = json.loads((PROTOCOL / "schema/packed_tables.json").read_text())
MESSAGES = {m["type"]: m for m in SCHEMA["messages"]}
NAMED = {m["wire"]: m for m in SCHEMA["messages"]}
ENUMS = {e["name"]: e for e in SCHEMA["enums"]}
STRUCTS = {s["name"]: s for s in SCHEMA["structs"]}
LIMITS = SCHEMA["limits"]
GREATEST = 2**53 - 1

# The tables that no JSON file of protocol/ has, from the document itself.
SPEC = (PROTOCOL / "SPEC.md").read_text()


def table(name):
    rows = re.search(rf"generated: {name} -->\n.*?\n\|---.*?\n(.*?)<!-- end", SPEC, re.S).group(1).strip().split("\n")
    return [[cell.strip() for cell in row.strip("|").split("|")] for row in rows]


GROUPS = {int(bit): range(int(faps.split(" to ")[0]), int(faps.split(" to ")[1]) + 1) for bit, faps, _ in table("groups")}
STANDARD_STEPS = [float(row[7]) for row in table("faps") if int(row[0]) >= 3]

Face = namedtuple("Face", "viseme expression levels")  # (select1, select2, blend), (select1, intensity1, select2, intensity2),
NEUTRAL = Face((0, 0, 0), (0, 0, 0, 0), (0,) * 69)  # level of FAP i at i


class Refused(Exception):
    def __init__(self, code, where):
        super().__init__(f"{code} at {where or 'the whole'}")
        self.code, self.where = code, where


def held(value, least, most, where, code="out_of_range"):
    if not least <= value <= most:
        raise Refused(code, where)
    return value


def face(viseme, expression, levels, where):
    """A Face of values that were read, held within their ranges."""
    for name, value, most in zip(("select1", "select2", "blend"), viseme, (14, 14, 63)):
        held(value, 0, most, f"{where}/viseme/{name}")
    for name, value, most in zip(("select1", "intensity1", "select2", "intensity2"), expression, (6, 63, 6, 63)):
        held(value, 0, most, f"{where}/expression/{name}")
    for fap, level in enumerate(levels):
        held(level, -LIMITS["max_level"], LIMITS["max_level"], f"{where}/faps/{fap}")
    return Face(tuple(viseme), tuple(expression), tuple(levels))


# ---- Section 5; packed_reader.py has its packed form


class Bytes:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, count, where):
        if self.at + count > len(self.data):
            raise Refused("truncated", where)
        self.at += count
        return self.data[self.at - count : self.at]

    def u8(self, where):
        return self.take(1, where)[0]

    def varint(self, where, most=GREATEST, code="out_of_range"):
        value = shift = 0
        while True:
            byte = self.u8(where)
            value |= (byte & 127) << shift
            held(value, 0, GREATEST, where)
            shift += 7
            if byte < 128:
                return held(value, 0, most, where, code)
            held(shift, 0, 63, where)

    def f64(self, where, least=None, most=None):
        value = struct.unpack("<d", self.take(8, where))[0]
        if value != value or value in (float("inf"), float("-inf")):
            raise Refused("not_finite", where)
        return held(value, -1e999 if least is None else least, 1e999 if most is None else most, where)

    def flag(self, where):
        return bool(held(self.u8(where), 0, 1, where, "malformed"))

    def text(self, most, where):
        raw = self.take(self.varint(where, most, "too_large"), where)
        try:
            return raw.decode("utf-8")  # Python's is strict: no surrogates, no overlong forms
        except UnicodeDecodeError:
            raise Refused("malformed", where) from None


def read_field(source, field, where):
    kind = field["type"]
    if kind == "uint":
        return source.varint(where, field["max"])
    if kind == "real":
        return source.f64(where, field.get("min"), field.get("max"))
    if kind == "bool":
        return source.flag(where)
    if kind == "text":
        return source.text(field["max"], where)
    if kind == "bytes":
        return source.take(source.varint(where, field["max"], "too_large"), where)
    if kind == "enum":
        return enum_value(field["enum"], source.u8(where), where)
    if kind == "reals":
        count = source.varint(where)
        if count not in field["lengths"]:
            raise Refused("out_of_range", where)
        return [source.f64(where, field["min"], field["max"]) for _ in range(count)]
    if not source.flag(where):  # optional, optional_real
        return None
    if kind == "optional_real":
        return source.f64(where, field["min"], field["max"])
    fields = STRUCTS[field["struct"]]["fields"]
    return {f["name"]: read_field(source, f, f"{where}/{f['name']}") for f in fields}


def enum_value(name, number, where):
    values = ENUMS[name]["values"]
    if number >= len(values):
        if not ENUMS[name]["open"]:
            raise Refused("out_of_range", where)
        number = 0
    return values[number]["name"]


def appended(field):
    return field.get("appended") or field["type"] == "optional_real"


def default(field):
    if field["type"] == "enum":
        return ENUMS[field["enum"]]["values"][0]["name"]
    return {"uint": 0, "real": 0, "bool": False, "text": "", "reals": []}.get(field["type"])


def put(message, field, value):
    """Left out of the JSON form: what is absent, and appended fields that have their default."""
    if value is not None and not (appended(field) and field["type"] != "optional_real" and value == default(field)):
        message[field["name"]] = value


def opus_packet_ms(packet):
    """How long it lasts by its first bytes, as section 2.1 has it; None: it is no packet."""
    if not packet or (packet[0] % 4 == 3 and len(packet) < 2):
        return None
    frames = (1, 2, 2, packet[1] % 64 if packet[0] % 4 == 3 else 0)[packet[0] % 4]
    kind = packet[0] // 8
    ms = (10, 20, 40, 60)[kind % 4] if kind < 12 else (10, 20)[kind % 2] if kind < 16 else (2.5, 5, 10, 20)[kind % 4]
    return frames * ms if 0 < frames * ms <= 120 else None


WORD = re.compile(r"[^ \t\r\n]+")


def score_steps(score):
    """(viseme, 1 where a word begins, ms) of each step, as section 2.2 has it; None: it is no score."""
    steps, at = [], 0
    while at < len(score):
        high, low = divmod(score[at], 16)
        at += 1
        if high < 15:
            steps.append((high, low // 8, (low % 8 + 1) * 30))
        elif low > 6 or (low > 0 and (at == len(score) or score[at] > 63)):
            return None
        else:
            at += low > 0
    return steps


class Reader:
    """Reads the messages of one connection in order. A message that is refused changes nothing."""

    def __init__(self):
        self.steps = STANDARD_STEPS
        self.packed = None

    def binary(self, data):
        """The message that these bytes are; Refused if they are none."""
        if len(data) > LIMITS["max_binary_message_bytes"]:
            raise Refused("too_large", "")
        source = Bytes(data)
        kind = source.u8("/type")
        if kind == NAMED["keyframe"]["type"] or kind >= NAMED["frames"]["type"]:
            return self._packed(kind, source)
        if kind == 13:
            from packed_text_reader import packed_text

            return self._taken(packed_text(data))
        if kind not in MESSAGES:
            raise Refused("unsupported", "/type")
        message = {"type": MESSAGES[kind]["wire"]}
        for field in MESSAGES[kind]["fields"]:
            if not (appended(field) and source.at == len(data)):
                put(message, field, read_field(source, field, "/" + field["name"]))
        return self._taken(message)

    def _taken(self, message):
        if message["type"] == "header":
            self.steps = message["quantizers"] or STANDARD_STEPS
        if message["type"] == "sound" and not opus_packet_ms(message["packet"]):
            raise Refused("malformed", "/packet")
        if message["type"] == "text":
            steps = score_steps(message.get("score", b""))
            if steps is None or sum(begins for _, begins, _ in steps) != len(WORD.findall(message.get("text", ""))):
                raise Refused("malformed", "/score")
        return message

    def _packed(self, kind, source):
        from packed_reader import PackedState

        if kind == NAMED["keyframe"]["type"]:
            sequence, media_time = source.varint("/sequence"), source.varint("/media_time")
            self.packed = PackedState.of_keyframe(sequence, media_time, source.data[source.at :])
            return {"type": "keyframe", "sequence": sequence, "media_time": media_time, "state": self.packed.past[0]}
        if self.packed is None or (self.packed.sequence + 1) % 128 != kind - 128:
            raise Refused("mismatch", "/sequence")
        after, media_time, frames = self.packed.after_batch(source.data[1:])
        message = {"type": "frames", "sequence": self.packed.sequence + 1, "media_time": media_time, "frames": frames}
        self.packed = after
        return message

    # ---- Section 4

    def text(self, text):
        """The message that this JSON text is; Refused if it is none."""

        def no_number(name):
            raise ValueError(name)

        try:
            document = json.loads(text, parse_constant=no_number)
        except ValueError:
            raise Refused("malformed", "") from None
        return self.document(document)

    def document(self, document):
        wants(document, dict, "")
        name = wants(member(document, "type", ""), str, "/type")
        if name not in NAMED:
            raise Refused("unsupported", "/type")
        message = {"type": name}
        for field in NAMED[name]["fields"]:
            self._member(document, field, message, "")
        return self._taken(message)

    def _member(self, document, field, message, where):
        name, kind = field["name"], field["type"]
        if kind in ("state", "frames"):
            member(document, name, where)
        where += "/" + name
        if kind == "state":
            message[name] = self._face(document[name], where)
        elif kind == "frames":
            message[name] = self._frames(wants(document[name], list, where), where)
        elif name not in document:
            if field.get("required"):
                raise Refused("missing", where)
            put(message, field, default(field))
        else:
            put(message, field, json_field(document[name], field, where))

    def _frames(self, items, where):
        held(len(items), 1, LIMITS["max_frames_per_message"], where)
        frames, time = [], 0
        for i, item in enumerate(items):
            at = f"{where}/{i}"
            wants(item, dict, at)
            time = held(whole(item.get("time", time), at + "/time"), time, LIMITS["max_frame_time"], at + "/time")
            frames.append((time, self._face(item, at)))
        return frames

    def _face(self, item, where):
        wants(item, dict, where)
        viseme, expression, levels = NEUTRAL.viseme, NEUTRAL.expression, [0] * 69
        if "viseme" in item:
            viseme = parts(item["viseme"], (("select1", None), ("select2", 0), ("blend", 63)), where + "/viseme")
        if "expression" in item:
            names = (("select1", None), ("intensity1", 63), ("select2", 0), ("intensity2", 0))
            expression = parts(item["expression"], names, where + "/expression")
        for name, value in wants(item.get("faps", {}), dict, where + "/faps").items():
            at = f"{where}/faps/{name.replace('~', '~0').replace('/', '~1')}"
            if name not in map(str, range(3, 69)):
                raise Refused("out_of_range", at)
            ratio = wants(value, (int, float), at) / self.steps[int(name) - 3]
            levels[int(name)] = int(abs(ratio) + 0.5) * (-1 if ratio < 0 else 1)
        return face(viseme, expression, levels, where)


def member(document, name, where):
    if name not in document:
        raise Refused("missing", f"{where}/{name}")
    return document[name]


def wants(value, kinds, where):
    if not isinstance(value, kinds) or (isinstance(value, bool) and kinds is not bool):
        raise Refused("malformed", where)
    return value


def whole(value, where):
    wants(value, (int, float), where)
    return wants(int(value) if value == int(value) else value, int, where)


def parts(item, names, where):
    wants(item, dict, where)
    values = [member(item, name, where) if other is None else item.get(name, other) for name, other in names]
    return tuple(whole(value, f"{where}/{name}") for value, (name, _) in zip(values, names))


def json_field(value, field, where):
    kind = field["type"]
    if kind == "uint":
        return held(whole(value, where), 0, field["max"], where)
    if kind in ("real", "optional_real"):
        wants(value, (int, float), where)
        return held(value, field.get("min", -1e999), field.get("max", 1e999), where)
    if kind == "bool":
        return wants(value, bool, where)
    if kind == "text":
        held(len(wants(value, str, where).encode()), 0, field["max"], where, "too_large")
        return value
    if kind == "bytes":
        try:
            data = base64.b64decode(wants(value, str, where), validate=True)
        except binascii.Error:
            raise Refused("malformed", where) from None
        held(len(data), 0, field["max"], where, "too_large")
        return data
    if kind == "enum":
        names = [v["name"] for v in ENUMS[field["enum"]]["values"]]
        if wants(value, str, where) not in names and not ENUMS[field["enum"]]["open"]:
            raise Refused("invalid_argument", where)
        return value if value in names else names[0]
    if kind == "reals":
        if len(wants(value, list, where)) not in field["lengths"]:
            raise Refused("out_of_range", where)
        return [held(wants(v, (int, float), where), field["min"], field["max"], where) for v in value]
    wants(value, dict, where)
    result = {}
    for inner in STRUCTS[field["struct"]]["fields"]:
        at = f"{where}/{inner['name']}"
        result[inner["name"]] = json_field(member(value, inner["name"], where), inner, at)
    return result
