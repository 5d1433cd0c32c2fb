#!/usr/bin/env python3
"""The voice of the example, but a part of a text with the word "late" takes two seconds, with "never" ten minutes, and with
"broken" the voice fails."""

import io
import json
import pathlib
import runpy
import sys
import time

request = sys.stdin.buffer.read(160_000)
text = json.loads(request).get("text", "")
if "broken" in text:
    sys.exit("the string is torn")
time.sleep(600 if "never" in text else 2 if "late" in text else 0)
sys.stdin = io.TextIOWrapper(io.BytesIO(request))
runpy.run_path(str(pathlib.Path(__file__).parents[3] / "server/voice/examples/beeps.py"), run_name="__main__")
