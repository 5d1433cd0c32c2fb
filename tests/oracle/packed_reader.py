"""The packed form of section 5 of protocol/SPEC.md, written from that document alone, as stream_reader.py, and as literally."""

from stream_reader import GREATEST, GROUPS, LIMITS, NEUTRAL, PACKED, Refused, face, held

TABLES = {t["name"]: t["values"] for t in PACKED["tables"]}
REFERENCE = PACKED["references"]
GROUP_OF = {fap: group for group, faps in GROUPS.items() for fap in faps}


class RangeDecoder:
    def __init__(self, data, where):
        self.data, self.at, self.where, self.range, self.code = data, 0, where, 2**32 - 1, 0
        for _ in range(4):
            self._shift()
        if self.code == 2**32 - 1:
            raise Refused("malformed", "")

    def _shift(self):
        if self.at >= len(self.data) + 4:
            raise Refused("truncated", self.where)
        byte = self.data[self.at] if self.at < len(self.data) else 0
        self.at += 1
        self.code = self.code << 8 | byte

    def _renormalize(self):
        while self.range < 2**24:
            self._shift()
            self.range <<= 8

    def bit(self, name, *index_and_sizes):
        """index_and_sizes: index of the slowest part, then size and index of each faster one."""
        place = index_and_sizes[0] if index_and_sizes else 0
        for size, index in zip(index_and_sizes[1::2], index_and_sizes[2::2]):
            place = place * size + index
        return self.chance(TABLES[name][place])

    def chance(self, chance):
        """A bit that is 1 with this chance, in 4096ths."""
        bound = self.range // 4096 * chance
        value = int(self.code < bound)
        if value:
            self.range = bound
        else:
            self.code -= bound
            self.range -= bound
        self._renormalize()
        return value

    def even(self):
        self.range //= 2
        value = int(self.code >= self.range)
        if value:
            self.code -= self.range
        self._renormalize()
        return value

    def number(self, name, row, most):
        k = 0
        while k < most and self.bit(name, row, most, k):
            k += 1
        value = 1
        for i in range(k):
            table = ("top_bit", "second_bit")[i] if i < 2 else None
            value = value * 2 + (self.bit(table, min(k, 16)) if table else self.even())
        return value - 1

    def signed(self, negative, name, row, most):
        size = self.number(name, row, most) + 1
        return -size if negative else size

    def tree(self, name, row, bits):
        node = 1
        for _ in range(bits):
            node = 2 * node + self.bit(name, row, 2**bits, node)
        return node - 2**bits

    def finish(self):
        if self.at < len(self.data):
            raise Refused("malformed", self.where)


def clamp(level):
    return max(-LIMITS["max_level"], min(LIMITS["max_level"], level))


def clamp63(blend):
    return max(0, min(63, blend))


def sign_of(x):
    return (x > 0) - (x < 0)


def ratio(s, t, x):
    if s == 0:
        return x
    q = (2 * abs(t * x) + abs(s)) // (2 * abs(s)) * sign_of(t * x) * sign_of(s)
    if abs(q - x) > 2 * abs(t - s):
        q = x + t - s
    return clamp(q)


class PackedState:
    """What both sides keep: `past` is A, B, C, D."""

    def __init__(self):
        self.past, self.sequence, self.time, self.step, self.count = [NEUTRAL] * 4, 0, 0, 40, 1
        self.time_class = self.viseme_class = self.expression_class = 0

    @staticmethod
    def of_keyframe(sequence, media_time, code):
        new, where = PackedState(), "/state"
        coder = RangeDecoder(code, where)
        if coder.bit("join_differs"):
            new._read_count(coder)
            new.step = held(new._read_time(coder, 1, new.step, where + "/step"), 1, LIMITS["max_frame_time"], where + "/step")
            new.time_class = held(2 * coder.even() + coder.even(), 0, 2, where + "/step")
            for _ in range(4):
                new._read_frame(coder, where)
        else:
            new._read_frame(coder, where)
            new.past = [new.past[0]] * 4
            new.viseme_class = new.expression_class = 0
        coder.finish()
        new.sequence, new.time = sequence, media_time
        return new

    def _copy(self):
        new = PackedState()
        new.__dict__.update(self.__dict__, past=list(self.past))
        return new

    def after_batch(self, code):
        """The state after the batch, its media time, its frames."""
        new, coder = self._copy(), RangeDecoder(code, "/frames")
        new._read_count(coder)
        base = new._read_time(coder, 0, min(new.time + new.step, GREATEST), "/media_time")
        new._take_step(base - new.time)
        time, frames = 0, []
        if coder.bit("offset_differs"):
            time = coder.number("time_length", 0, 53) + 1
        for i in range(new.count):
            where = f"/frames/{i}"
            if i:
                step = new._read_time(coder, 1, new.step, where + "/time")
                new._take_step(step)
                time += step
            held(time, 0, LIMITS["max_frame_time"], where + "/time")
            held(base + time, 0, GREATEST, where + "/time")
            new._read_frame(coder, where)
            frames.append((time, new.past[0]))
        coder.finish()
        new.time, new.sequence = base + time, new.sequence + new.count
        return new, base, frames

    def _take_step(self, step):
        if 1 <= step <= LIMITS["max_frame_time"]:
            self.step = step

    def _read_count(self, coder):
        if coder.bit("count_differs"):
            self.count = held(coder.number("count_length", 0, 10) + 1, 1, LIMITS["max_frames_per_message"], "/frames")

    def _read_time(self, coder, first, expected, where):
        if not coder.bit("time_differs", first, 3, self.time_class):
            self.time_class = 0
            return expected
        later = coder.signed(coder.bit("time_sign", first), "time_length", 0, 53)
        self.time_class = 2 if later < 0 else 1
        return held(expected + later, 0, GREATEST, where)

    def _read_frame(self, coder, where):
        viseme = self._read_viseme(coder)
        held(viseme[0], 0, 14, where + "/viseme/select1")
        expression = self._read_expression(coder)
        newest = face(viseme, expression, self._read_levels(coder, where), where)
        self.past = [newest] + self.past[:3]

    def _read_viseme(self, coder):
        one, two, x = self.past[0].viseme
        old_one, old_two, old_blend = self.past[1].viseme
        if not coder.bit("viseme_differs", self.viseme_class):
            self.viseme_class = 0
            return one, two, x
        row = 2 if x != 63 else 0 if two == 0 else 1
        if coder.bit("viseme_kind", row, 4, 0):
            kind = 2
            if coder.bit("viseme_kind", row, 4, 2):
                kind = 3 + coder.bit("viseme_kind", row, 4, 3)
        else:
            kind = coder.bit("viseme_kind", row, 4, 1)
        self.viseme_class = kind + 1
        if kind >= 2:
            select1 = (one, two)[kind - 2] if kind < 4 else coder.tree("viseme_select", 0, 4)
            second = coder.bit("viseme_second", kind - 2)
            select2 = coder.tree("viseme_select", 0, 4) if second else 0
            blend = 62 - coder.number("blend_length", 0, 5) if coder.bit("blend_differs", 1 - second) else 63
            return select1, select2, blend
        u = 0
        if (old_one, old_two) == (one, two):
            y = old_blend
        elif (old_one, old_two) == (two, one):
            y = 63 - old_blend
        elif old_blend == 63 and old_one in (one, two):
            y = 63 if old_one == one else 0
        else:
            y, u = x, 1
        blend = clamp63(2 * x - y)
        if coder.bit("share_differs", u):
            blend += coder.signed(coder.bit("share_sign", int(x > y), 2, u), "share_length", u, 5)
        return (one, two, blend) if kind == 0 else (two, one, 63 - blend)

    def _read_expression(self, coder):
        before, old = self.past[0].expression, self.past[1].expression
        self.expression_class = coder.bit("expression_differs", self.expression_class)
        if not self.expression_class:
            return before
        one, two = before[0], before[2]
        if coder.bit("expression_kind", 0):
            one, two = two, one
            if coder.bit("expression_kind", 1):
                one, two = coder.tree("expression_select", 0, 3), coder.tree("expression_select", 1, 3)
        intensities = []
        for select in (one, two):
            x, y = intensity(before, select), intensity(old, select)
            known = x is not None
            x, y = x or 0, y or 0
            row = 2 if select == 0 else 0 if known else 1
            column = 0 if not known or x == y else 1 if x < y else 2
            value = clamp63(2 * x - y)
            if coder.bit("intensity_differs", row, 3, column):
                negative = coder.bit("intensity_sign", row, 3, column)
                value += coder.signed(negative, "intensity_length", 0 if known else 1, 5)
            intensities.append(value)
        return one, intensities[0], two, intensities[1]

    def _read_levels(self, coder, where):
        a_all, b_all, c_all, d_all = (f.levels for f in self.past)
        levels, off = list(a_all), [0] * 69
        for group, faps in GROUPS.items():
            still = set()
            for fap in faps:
                ref = REFERENCE[fap]
                ref_still = not ref or GROUP_OF[ref] == group or levels[ref] == a_all[ref]
                if ref_still and a_all[fap] == b_all[fap] == c_all[fap] == d_all[fap]:
                    still.add(fap)
            moves = not still or coder.bit("group_moves", group - 2, 2, int(len(still) == len(faps)))
            for fap in faps:
                if fap not in still or moves:
                    levels[fap], off[fap] = self._read_level(coder, fap, levels, off)
                    held(levels[fap], -LIMITS["max_level"], LIMITS["max_level"], f"{where}/faps/{fap}")
        return levels

    def _read_level(self, coder, fap, levels, off):
        """Level and how far off the guess was."""
        a, b, c, d = (f.levels[fap] for f in self.past)
        ref = REFERENCE[fap]
        line = (clamp(2 * a - b), 2 * abs(a - clamp(2 * b - c)) + abs(b - clamp(2 * c - d)), 0)
        hold = (a, 2 * abs(a - b) + abs(b - c), 2)
        m = o = 0
        if ref:
            r = levels[ref]
            ra, rb, rc = (f.levels[ref] for f in self.past[:3])
            shift = (clamp(a + r - ra), 2 * abs(a - clamp(b + ra - rb)) + abs(b - clamp(c + rb - rc)), 1)
            part = (ratio(ra, r, a), 2 * abs(a - ratio(rb, ra, b)) + abs(b - ratio(rc, rb, c)), 1)
            guesses = (shift, part, line, hold)
            m, o = abs(r - ra), sign_of(off[ref]) % 3
        else:
            guesses = (line, hold)
        g, cost, kind = min(guesses, key=lambda guess: guess[1])  # the first of the cheapest
        shared, w = kind == 1, min(o, 1)
        e = 0
        if shared and cost == 0:
            i = min(m.bit_length(), 7)
            if coder.bit("follower_differs", i, 2, w):
                e = coder.signed(coder.bit("follower_sign", o), "level_length", 10 + min(i, 4), 15)
        elif max(abs(a - b), abs(b - c), abs(c - d)) <= 1 and (not shared or m == 0):
            pattern = 9 * (a - b) + 3 * (b - c) + (c - d)
            s, pattern = (-1, -pattern) if pattern < 0 else (1, pattern)
            j, z = min(m, 2), min(m, 1)
            level = a
            if coder.bit("slow_differs", pattern, 2, z):
                if coder.bit("slow_sign", pattern, 2, z):
                    s = -s
                more = coder.bit("slow_more", j, 2, int(pattern != 0))
                level += s * (coder.number("level_length", 16 if j == 2 else 15, 15) + 2 if more else 1)
            return level, level - g
        else:
            i = min(cost.bit_length(), 9)
            row = 0 if not ref else 1 + w if shared else 3 + w
            if coder.bit("level_differs", row, 10, i):
                e = coder.signed(coder.bit("level_sign", kind, 3, o), "level_length", i, 15)
        return g + e, e


def intensity(expression, select):
    if select == 0:
        return None
    if expression[0] == select:
        return expression[1]
    return expression[3] if expression[2] == select else None
