#!/usr/bin/env python3
"""How soon a stream is heard after it was asked to say a text. Python 3, standard library.

    first_sound.py PROGRAM [TIMES]     PROGRAM: build/bin/semblante, with its voice beside it

From the request POST .../speech to the first Opus packet at a subscriber on this machine, for texts of several lengths. The baseline
is the same text as SSML, which a voice speaks whole before anything plays. The median and the worst of TIMES (default 5)."""

import contextlib
import statistics
import sys
import time
from xml.sax.saxutils import escape

import minute

LENGTHS = (1, 4, 12)  # times the text


class Ear(minute.Subscriber):
    """Knows when the first packet of sound came."""

    def __init__(self, port):
        super().__init__(port, True)
        self.first = None

    def heard(self):
        self.first = self.first or time.monotonic()


def wait(port, text, ssml):
    """Seconds to the first packet, ms of sound."""
    assert minute.ask(port, "POST", "/v1/streams", {"name": "talk"})[0] == 201
    ear = Ear(port)
    ear.start()
    time.sleep(0.2)
    begun = time.monotonic()
    status, playing = minute.ask(port, "POST", "/v1/streams/talk/speech", {"text": f"<speak>{escape(text)}</speak>" if ssml else text, "ssml": ssml, "language": "en"})
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
        print("| text | sound | sentence by sentence: median, worst | whole first: median, worst | ratio |\n|---|---|---|---|---|")
        for length in LENGTHS:
            long_text = " ".join([text] * length)
            rounds = [(wait(server.port, long_text, False), wait(server.port, long_text, True)) for _ in range(times)]
            parts, whole = ([1000 * one[way][0] for one in rounds] for way in (0, 1))
            ratio = statistics.median(whole) / statistics.median(parts)
            figures = [f"{statistics.median(way):.0f} ms, {max(way):.0f} ms" for way in (parts, whole)]
            print(f"| {len(long_text)} bytes | {rounds[0][0][1] / 1000:.0f} s | {figures[0]} | {figures[1]} | {ratio:.1f} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5)
