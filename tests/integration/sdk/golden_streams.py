"""The golden streams of protocol/vectors as input of probe.c, and what the library makes of them held to the golden values."""

import json
import pathlib

TOP = pathlib.Path(__file__).resolve().parents[3]
VECTORS = TOP / "protocol/vectors/v1"
HEADER = next(m["binary"] for m in json.loads((VECTORS / "messages.json").read_text())["messages"]
              if m["name"] == "header with the standard steps")
STREAMS = json.loads((VECTORS / "packed.json").read_text())["streams"]


def lines():
    """The input of the probe."""
    return "".join("\n".join(["stream", HEADER] + [m["binary"] for m in stream["messages"]]) + "\n" for stream in STREAMS)


def faults(output):
    """Where the probe's output differs from the golden values: frames one by one, with values of FAP units."""
    found, heard = [], output.split("stream\n")[1:]
    if len(heard) != len(STREAMS):
        return [f"{len(heard)} streams, not {len(STREAMS)}"]
    for stream, text in zip(STREAMS, heard):
        expected = []
        for message in (m["json"] for m in stream["messages"]):
            if message["type"] == "frames":
                expected += [(f, message["media_time"] + f["time"]) for f in message["frames"]]
        got, kind, faces = [], "", 0
        for line in text.splitlines():
            word, *values = line.split()
            if word in ("keyframe", "frames"):
                kind = word
            elif word == "frame" and kind == "frames":
                got.append([float.fromhex(values[0]), [int(v) for v in values[1:]], None])
            elif word == "faps" and kind == "frames":
                got[-1][2] = [float.fromhex(v) for v in values]
            elif word == "fault":
                found.append(f"{stream['name']}: {line}")
            faces += word == "positions"
        if len(got) != len(expected) or faces != 1:
            found.append(f"{stream['name']}: {len(got)} frames, not {len(expected)}; {faces} faces")
            continue
        for number, ((frame, moment), (time, high, faps)) in enumerate(zip(expected, got)):
            if time != moment:
                found.append(f"{stream['name']}, frame {number}: at {time}, not {moment} ms")
            v, e = frame["viseme"], frame["expression"]
            if high != [v["select1"], v["select2"], v["blend"], e["select1"], e["intensity1"], e["select2"], e["intensity2"]]:
                found.append(f"{stream['name']}, frame {number}: viseme and expression {high}")
            for index, value in enumerate(faps, 3):
                if value != frame["faps"].get(str(index), 0):
                    found.append(f"{stream['name']}, frame {number}: FAP {index} is {value}")
    return found
