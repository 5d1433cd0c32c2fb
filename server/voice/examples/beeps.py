#!/usr/bin/env python3
"""A voice as short as can be: each letter is a tone of 90 ms. Shows the protocol of server/voice/README.md."""

import base64
import json
import math
import re
import struct
import sys

RATE, LETTER_MS, PAUSE_MS = 8000, 90, 150
request = json.loads(sys.stdin.buffer.read(160_000))
letter_ms = LETTER_MS / request.get("rate", 1)
clock = 0.0


def say(**line):
    print(json.dumps(line))


def sound(ms, hertz):
    global clock
    samples = [int(6000 * math.sin(2 * math.pi * hertz * i / RATE)) if hertz else 0 for i in range(int(ms * RATE / 1000))]
    say(audio=base64.b64encode(struct.pack(f"<{len(samples)}h", *samples)).decode())
    clock += 1000 * len(samples) / RATE


if request["protocol"] == 1 and request.get("list"):
    say(protocol=1, name="beeps", sample_rate=RATE)
    say(voice="beeps", label="Tones", language="en")
    say(end=True)
    sys.exit(0)
if request["protocol"] != 1:
    say(error="this voice speaks protocol 1")
    sys.exit(2)
if request.get("ssml"):
    say(error="this voice speaks plain text", of="text")
    sys.exit(2)
say(protocol=1, name="beeps", sample_rate=RATE)
say(sentence=0, time=0)
for word in re.finditer(r"\w+", request["text"]):
    say(word=[word.start(), len(word.group())], time=clock)
    for letter in word.group().lower():
        vowel = letter in "aeiouáéíóúâêôãõà"
        say(phoneme=letter, time=clock, stress=1 if vowel else 0)
        sound(letter_ms, 180 + 40 * (ord(letter) % 12) if vowel else 120)
    say(phoneme="", time=clock)
    sound(PAUSE_MS, 0)
say(end=True)
