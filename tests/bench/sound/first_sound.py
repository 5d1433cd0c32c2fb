#!/usr/bin/env python3
"""How soon a stream is heard after it was asked to say a text. Python 3, standard library.

    first_sound.py PROGRAM [TIMES]     PROGRAM: build/bin/semblante, with its voice beside it

From the request POST .../speech to the first Opus packet at a subscriber on this machine, for texts of several lengths. Beside it the
same text as SSML, and as one element s, which a voice speaks whole before anything plays: the baseline. The median and the worst of TIMES (default 5)."""

import contextlib
import statistics
import sys
import time
from xml.sax.saxutils import escape

import minute

LENGTHS = (1, 4, 12)  # times the text
FORMS = ("{}", "<speak>{}</speak>", "<speak><s>{}</s></speak>")


class Ear(minute.Subscriber):
    """Knows when the first packet of sound came."""

    def __init__(self, port):
        super().__init__(port, True)
        self.first = None

    def heard(self):
        self.first = self.first or time.monotonic()


def wait(port, text, form):
    """Seconds to the first packet, ms of sound."""
    assert minute.ask(port, "POST", "/v1/streams", {"name": "talk"})[0] == 201
    ear = Ear(port)
    ear.start()
    time.sleep(0.2)
    begun = time.monotonic()
    status, playing = minute.ask(port, "POST", "/v1/streams/talk/speech", {"text": text if form == "{}" else form.format(escape(text)), "ssml": form != "{}", "language": "en"})
    assert status == 202, playing
    while ear.first is None:
        assert time.monotonic() < begun + 60
        time.sleep(0.001)
    while not (play := minute.ask(port, "GET", "/v1/streams/talk")[1]["playing"])["complete"]:
        time.sleep(0.05)
    assert minute.ask(port, "DELETE", "/v1/streams/talk")[0] == 204
    return ear.first - begun, play["duration"]


def main(program, times):
    text = minute.text_of(minute.TEXT)
    with contextlib.closing(minute.Server(program)) as server:
        print("| text | sound | text: median, worst | SSML: median, worst | whole first: median, worst | whole to SSML |\n|---|---|---|---|---|---|")
        for length in LENGTHS:
            long_text = " ".join([text] * length)
            rounds = [[wait(server.port, long_text, form) for form in FORMS] for _ in range(times)]
            ways = [[1000 * one[way][0] for one in rounds] for way in range(len(FORMS))]
            ratio = statistics.median(ways[2]) / statistics.median(ways[1])
            figures = " | ".join(f"{statistics.median(way):.0f} ms, {max(way):.0f} ms" for way in ways)
            print(f"| {len(long_text)} bytes | {rounds[0][0][1] / 1000:.0f} s | {figures} | {ratio:.1f} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5)
