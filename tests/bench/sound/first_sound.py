#!/usr/bin/env python3
"""How soon a stream is heard after it was asked to say a text. Python 3, standard library.

    first_sound.py PROGRAM [TIMES]          PROGRAM: build/bin/semblante, with its voice beside it
    first_sound.py PROGRAM --runs RUNS

From the request to the first Opus packet at a subscriber on this machine, for texts of several lengths. Beside it the same text as SSML, and
as a speech that is made whole before the stream plays it: the baseline. Then texts without sentences, and hostile ones. The median and
the worst of TIMES (default 5).

With --runs: RUNS runs, a quarter each of a sentence, SSML, Thai and a long text, in turn, with percentiles and the processor time that the
server and its voice take for a run, until it is stopped at its first sound. Exit status 1 if one waits longer than 300 ms, the silence before the first
word included."""

import contextlib
import os
import pathlib
import statistics
import sys
import time
from xml.sax.saxutils import escape

import minute

LENGTHS = (1, 4, 12)  # times the text
WAYS = ("text", "SSML", "whole first")
HOSTILE = {
    "one word of letters": "a" * 19000,
    "letters and periods": "a.b.c.d.e.f.g." * 1400,
    "words without periods": "banana casa " * 1600,
    "digits": "1234567890" * 1900,
    "periods": "." * 19000 + "a",
    "smileys": ":) " * 6000 + "hello",
    "emoji": "\U0001F600" * 4700 + "a",
    "spans and signs": "[joy 0.5]a[/joy](b),c;d:e!f?" * 680,
    "SSML, one say-as": '<speak><say-as interpret-as="characters">' + "x7" * 9000 + "</say-as></speak>",
    "SSML, a mark at each letter": "<speak>" + 'a<mark name="a"/>' * 1100 + "</speak>",
}

RUNS = {
    "a sentence": {"text": "Good morning! How are you today?", "language": "en"},
    "SSML": {"text": '<speak>Olá! <break time="200ms"/><prosody rate="slow">Como vai?</prosody> <emphasis>Muito</emphasis> prazer.</speak>', "language": "pt-BR", "ssml": True},
    "Thai, 1.2 kB": {"text": "สวัสดีครับวันนี้อากาศดีมากเราไปเดินเล่นกัน" * 10, "language": "en"},
    "long text, 9 kB": {"text": " ".join([minute.text_of(minute.TEXT)] * 12), "language": "en"},
}
LEAD = 0.12  # s of silence in which the mouth gets ready: server/voice/README.md
GOAL = 0.3


class Ear(minute.Subscriber):
    """Knows when the first packet of sound came."""

    def __init__(self, port):
        super().__init__(port, True)
        self.first = None

    def heard(self):
        self.first = self.first or time.monotonic()


def said(text, way):
    is_text = way != "SSML" or text.startswith("<speak>")
    return {"text": text if is_text else f"<speak>{escape(text)}</speak>", "ssml": way == "SSML", "language": "en"}


def wait(port, wish, way=""):
    """Seconds to the first packet, ms of sound that have been made by then."""
    assert minute.ask(port, "POST", "/v1/streams", {"name": "talk"})[0] == 201
    ear = Ear(port)
    ear.start()
    time.sleep(0.2)
    begun = time.monotonic()
    if way == "whole first":
        status, speech = minute.ask(port, "POST", "/v1/speeches", wish)
        assert status == 201, speech
        wish = {"speech": speech["id"]}
    status, playing = minute.ask(port, "POST", "/v1/streams/talk/speech", wish)
    assert status == 202, playing
    while ear.first is None:
        assert time.monotonic() < begun + 60
        time.sleep(0.001)
    assert minute.ask(port, "DELETE", "/v1/streams/talk")[0] == 204
    return ear.first - begun, playing["duration"]


def figures(waits):
    return f"{1000 * statistics.median(waits):.0f} ms, {1000 * max(waits):.0f} ms"


def processor(server):
    """Seconds of processor that the server and those that it started and that have ended took."""
    fields = pathlib.Path(f"/proc/{server.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, round(share * (len(values) - 1)))]


def runs(program, count):
    with contextlib.closing(minute.Server(program)) as server:
        waits, work = {name: [] for name in RUNS}, dict.fromkeys(RUNS, 0)
        for run in range(count):
            name = list(RUNS)[run % len(RUNS)]
            before = processor(server)
            waits[name].append(wait(server.port, RUNS[name])[0] + LEAD)
            work[name] += processor(server) - before
    rows = [(name, of, work[name] / len(of)) for name, of in waits.items()]
    everything = [one for of in waits.values() for one in of]
    rows.append(("all", everything, sum(work.values()) / len(everything)))
    print("| first sound, its silence of 120 ms included | runs | p50 | p95 | most | processor, a run |\n|---|---|---|---|---|---|")
    for name, of, seconds in rows:
        print(f"| {name} | {len(of)} | {' | '.join(f'{1000 * percentile(of, share):.0f} ms' for share in (0.5, 0.95, 1))} | {1000 * seconds:.0f} ms |")
    print(f"load of the machine: {os.getloadavg()[0]:.1f}")
    return 0 if max(everything) <= GOAL else 1


def main(program, times):
    text = minute.text_of(minute.TEXT)
    with contextlib.closing(minute.Server(program)) as server:
        print("| text | sound | text: median, worst | SSML: median, worst | whole first: median, worst | whole to SSML |\n|---|---|---|---|---|---|")
        for length in LENGTHS:
            long_text = " ".join([text] * length)
            rounds = [[wait(server.port, said(long_text, way), way) for way in WAYS] for _ in range(times)]
            ways = [[one[way][0] for one in rounds] for way in range(len(WAYS))]
            ratio = statistics.median(ways[2]) / statistics.median(ways[1])
            print(f"| {len(long_text)} bytes | {rounds[0][2][1] / 1000:.0f} s | {' | '.join(map(figures, ways))} | {ratio:.1f} |", flush=True)
        print("\n| hostile text | median, worst |\n|---|---|")
        for name, hostile in HOSTILE.items():
            way = "SSML" if hostile.startswith("<speak>") else "text"
            print(f"| {name} | {figures([wait(server.port, said(hostile, way))[0] for _ in range(times)])} |", flush=True)


if __name__ == "__main__":
    if sys.argv[2:3] == ["--runs"]:
        sys.exit(runs(sys.argv[1], int(sys.argv[3])))
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5)
