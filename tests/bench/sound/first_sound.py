#!/usr/bin/env python3
"""How soon a stream is heard after it was asked to say a text. Python 3, standard library.

    first_sound.py PROGRAM [TIMES]     PROGRAM: build/bin/semblante, with its voice beside it

From the request to the first Opus packet at a subscriber on this machine, for texts of several lengths. Beside it the same text as SSML, and
as a speech that is made whole before the stream plays it: the baseline. Then texts without sentences, and hostile ones. The median and
the worst of TIMES (default 5)."""

import contextlib
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


def wait(port, text, way):
    """Seconds to the first packet, ms of sound that have been made by then."""
    assert minute.ask(port, "POST", "/v1/streams", {"name": "talk"})[0] == 201
    ear = Ear(port)
    ear.start()
    time.sleep(0.2)
    begun = time.monotonic()
    wish = said(text, way)
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


def main(program, times):
    text = minute.text_of(minute.TEXT)
    with contextlib.closing(minute.Server(program)) as server:
        print("| text | sound | text: median, worst | SSML: median, worst | whole first: median, worst | whole to SSML |\n|---|---|---|---|---|---|")
        for length in LENGTHS:
            long_text = " ".join([text] * length)
            rounds = [[wait(server.port, long_text, way) for way in WAYS] for _ in range(times)]
            ways = [[one[way][0] for one in rounds] for way in range(len(WAYS))]
            ratio = statistics.median(ways[2]) / statistics.median(ways[1])
            print(f"| {len(long_text)} bytes | {rounds[0][2][1] / 1000:.0f} s | {' | '.join(map(figures, ways))} | {ratio:.1f} |", flush=True)
        print("\n| hostile text | median, worst |\n|---|---|")
        for name, hostile in HOSTILE.items():
            way = "SSML" if hostile.startswith("<speak>") else "text"
            print(f"| {name} | {figures([wait(server.port, hostile, way)[0] for _ in range(times)])} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5)
