"""The packed form of texts, of section 5 of protocol/SPEC.md, written from that document alone, as packed_reader.py."""

import json

from packed_reader import RangeDecoder
from stream_reader import GREATEST, LIMITS, PROTOCOL, Bytes, Refused

PRIME = json.loads((PROTOCOL / "schema/text_prime.json").read_text())["texts"]
CHANCES = [1, 2, 4, 6, 10, 17, 27, 45, 74, 120, 194, 311, 488, 747, 1102, 1546, 2048, 2550, 2994, 3349, 3608, 3785, 3902, 3976, 4022, 4051, 4069,
           4079, 4086, 4090, 4092, 4094, 4095]
LETTERS = {**dict.fromkeys(b"aeiouy", {10, 11, 12, 13, 14}), **dict.fromkeys(b"bmp", {1}), **dict.fromkeys(b"fv", {2}), ord("t"): {3, 4, 6},
           ord("d"): {4, 6}, **dict.fromkeys(b"gkq", {5, 6}), **dict.fromkeys(b"cx", {5, 6, 7}), ord("j"): {6}, **dict.fromkeys(b"sz", {6, 7}),
           ord("l"): {8, 14}, ord("n"): {8}, **dict.fromkeys(b"hr", {5, 9}), ord("w"): {14},
           **dict.fromkeys(range(192, 256), {7, 10, 11, 12, 13, 14})}
SPACES = b" \t\n\r"


def squash(logit):
    at, part = divmod(logit + 2048, 128)
    return (CHANCES[at] * (128 - part) + CHANCES[at + 1] * part + 64) // 128


LOGITS = []
for chance in range(4096):
    logit = LOGITS[-1] if LOGITS else -2047
    while logit < 2047 and squash(logit) < chance:
        logit += 1
    LOGITS.append(logit)


def fold(hash_, value):
    hash_ = (hash_ + value + 1) * 2654435761 % 2**32
    return hash_ ^ hash_ >> 15


def hashed(*values):
    hash_ = 0
    for value in values:
        hash_ = fold(hash_, value)
    return hash_


def lower(byte):
    return byte + 32 if 65 <= byte <= 90 else byte


class Known:
    """In place of a decoder: the bits of a text that is known."""

    def __init__(self):
        self.next = []

    def chance(self, _):
        return self.next.pop(0)


class Model:
    def __init__(self, before=None):
        self.slots = [{} if before is None else dict(before.slots[i]) for i in range(6)]
        self.weights = {} if before is None else dict(before.weights)

    def bit(self, coder, group, contexts, node):
        seen = []
        for i, context in enumerate(contexts):
            place = fold(context, node) >> 16
            chance, met = self.slots[i].get(place, (2048, 0))
            weight = self.weights.get((group, i, met), 21845)
            seen.append((i, place, chance, met, weight, LOGITS[chance] if met else 0))
        total = sum(weight * logit for *_, weight, logit in seen) >> 16
        mixed = squash(max(-2047, min(2047, total)))
        value = coder.chance(mixed)
        error = 6 * (4096 * value - mixed)
        for i, place, chance, met, weight, logit in seen:
            self.weights[group, i, met] = max(-(2**20), min(2**20, weight + (logit * error + 8192 >> 14)))
            fine = 16 * chance + 8
            fine = fine + (65535 - fine) // (met + 2) if value else fine - fine // (met + 2)
            self.slots[i][place] = fine // 16, min(met + 1, 14)
        return value

    def symbol(self, coder, group, contexts, bits):
        node = 1
        for _ in range(bits):
            node = 2 * node + self.bit(coder, group, contexts, node)
        return node - 2**bits

    def string(self, coder, kind, t, most, where):
        text, word = b"", 0
        while True:
            a, b, c, d = ([lower(byte) for byte in text[:-5:-1]] + [0] * 4)[:4]
            contexts = [hashed(kind), hashed(kind, t, a), hashed(kind, t, a, b), hashed(kind, t, a, b, c), hashed(kind, t, a, b, c, d),
                        hashed(kind, t, a, word)]
            byte = self.symbol(coder, 0, contexts, 8)
            if byte == 255:
                return text
            if len(text) == most:
                raise Refused("malformed", where)
            text += bytes([byte])
            byte = lower(byte)
            word = fold(word, byte) if byte >= 65 or byte == 39 else 0

    def score(self, coder, t, text):
        begins = [i for i in range(len(text)) if text[i] not in SPACES and (i == 0 or text[i - 1] in SPACES)]
        score, told = b"", 0
        begin = end = at = word = steps = newest = older = length = 0
        while True:

            def letter(i):
                return 1 if i < begin else 2 if i >= end else lower(text[i])

            def rest():
                return min(end - at, 3)

            def contexts(kind):
                return [hashed(kind, t, letter(at), letter(at + 1)), hashed(kind, t, letter(at - 1), letter(at), letter(at + 1), letter(at + 2)),
                        hashed(kind, newest, older), hashed(kind, t, newest, letter(at)), hashed(kind, t, word, steps),
                        hashed(kind, newest, rest(), length, int(told == len(begins)))]

            starts = self.bit(coder, 1, contexts(2), 1)
            if starts and told < len(begins):
                begin = end = at = begins[told]
                word = steps = 0
                while end < len(text) and text[end] not in SPACES:
                    word = fold(word, lower(text[end]))
                    end += 1
            viseme = self.symbol(coder, 1, contexts(3), 4)
            if starts and viseme == 15:
                return score
            if starts:
                told += 1
                if told > len(begins):
                    raise Refused("malformed", "/score")
            low = self.symbol(coder, 2, [hashed(4, viseme), hashed(4, viseme, newest), hashed(4, viseme, t, letter(at), letter(at + 1)),
                                         hashed(4, viseme, t, rest()), hashed(4, viseme, t, word, steps), hashed(4, viseme, length)], 3)
            score += bytes([16 * viseme + 8 * starts + low])
            if viseme == 15:
                if low == 7:
                    raise Refused("malformed", "/score")
                if low > 0:
                    score += bytes([self.symbol(coder, 2, [hashed(5)] * 6, 6)])
            else:
                for i in range(at, min(at + 3, end)):
                    if viseme in LETTERS.get(lower(text[i]), ()):
                        at = i + 1
                        while at < end and 128 <= text[at] < 192:
                            at += 1
                        break
                older, newest, length, steps = newest, viseme, low, steps + 1
            if len(score) > LIMITS["max_score_bytes"]:
                raise Refused("malformed", "/score")

    def message(self, coder):
        language = self.string(coder, 0, 0, 64, "/language")
        t = int(language.startswith(b"pt"))
        text = self.string(coder, 1, t, LIMITS["max_speech_text_bytes"], "/text")
        return language, text, self.score(coder, t, text)


def bits(value, count):
    return [value >> i & 1 for i in reversed(range(count))]


def primed():
    model = Model()
    for known in PRIME:
        coder = Known()
        for part in ("language", "text"):
            for byte in known[part].encode() + b"\xff":
                coder.next += bits(byte, 8)
        intensity = False
        for byte in bytes.fromhex(known["score"]):
            if intensity:
                coder.next += bits(byte, 6)
                intensity = False
            else:
                coder.next += bits(byte >> 3 & 1, 1) + bits(byte >> 4, 4) + bits(byte, 3)
                intensity = byte > 0xF0
        coder.next += bits(0xFF, 5)
        model.message(coder)
    return model


PRIMED = primed()


def packed_text(data):
    """The fields of a packed text, whose first byte is 13."""
    source = Bytes(data)
    source.u8("/type")
    speech, media_time = source.varint("/speech", GREATEST), source.varint("/media_time", GREATEST)
    try:
        coder = RangeDecoder(data[source.at :], "/text")
    except Refused:
        raise Refused("malformed", "/text") from None
    language, text, score = Model(PRIMED).message(coder)
    coder.finish()
    decoded = []
    for where, part in (("/language", language), ("/text", text)):
        try:
            decoded.append(part.decode("utf-8"))
        except UnicodeDecodeError:
            raise Refused("malformed", where) from None
    return {"type": "text", "speech": speech, "media_time": media_time, "language": decoded[0], "text": decoded[1], "score": score}
