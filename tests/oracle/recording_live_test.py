"""Records a stream with sound and holds what is recorded, exported and played again against what was heard, by the
independent reader.

Usage: recording_live_test.py PATH_OF_SEMBLANTE (which it starts)."""

import contextlib
import json
import struct
import subprocess
import sys
import tempfile
import threading
import time
import urllib.error
import urllib.request

from recording_reader import read_ogg_opus, read_recording
from stream_client import Closed, StreamClient

PATIENCE = 600  # seconds; only a hang lasts so long, on however busy a machine
RATE = 16000
PAUSE = (1.2, 2.2)  # s, in which nothing is said and no packet sent
LENGTH = 3.4  # s


def ask(port, method, path, body=None, kind="application/json"):
    data = json.dumps(body).encode() if isinstance(body, dict) else body
    request = urllib.request.Request(f"http://127.0.0.1:{port}{path}", data, {"Content-Type": kind}, method=method)
    with urllib.request.urlopen(request, timeout=PATIENCE) as answer:
        return answer.read()


def refusal(port, path):
    try:
        ask(port, "GET", path)
    except urllib.error.HTTPError as error:
        return error.code, json.loads(error.read())["detail"]
    raise AssertionError(f"{path} was not refused")


def wav():
    """A sawtooth, with a pause."""
    samples = bytearray()
    for i in range(int(LENGTH * RATE)):
        silent = PAUSE[0] <= i / RATE < PAUSE[1]
        samples += struct.pack("<h", 0 if silent else (i * 300) % 12000 - 6000)
    head = struct.pack("<4sI4s4sIHHIIHH4sI", b"RIFF", 36 + len(samples), b"WAVE", b"fmt ", 16, 1, 1, RATE, 2 * RATE, 2, 16, b"data", len(samples))
    return head + samples


def speech(port):
    """The id of a speech with sound; no voice is needed for it."""
    timeline = json.dumps({"words": ["Ma ", "pa."], "wtimes": [100, 2300], "wdurations": [900, 900],
                           "visemes": ["PP", "aa", "PP", "aa"], "vtimes": [100, 300, 2300, 2500], "vdurations": [200, 700, 200, 700]})
    parts = {"options": b'{"language":"en","text":"Ma pa."}', "timeline": timeline.encode(), "audio": wav()}
    form = b"".join(b'--cut\r\nContent-Disposition: form-data; name="%s"; filename="a"\r\n\r\n%s\r\n' % (name.encode(), content)
                    for name, content in parts.items()) + b"--cut--\r\n"
    return json.loads(ask(port, "POST", "/v1/speeches", form, "multipart/form-data; boundary=cut"))["id"]


class Listener(threading.Thread):
    def __init__(self, port, stream):
        super().__init__(daemon=True)
        self.client = StreamClient(port, stream)
        self.client.say("hello", version=1, sound=True)
        self.header = self.client.hear()
        self.sound, self.frames, self.still = [], [], threading.Event()

    def run(self):
        with contextlib.suppress(Closed):
            while True:
                self.take(self.client.hear())

    def take(self, message):
        if message["type"] == "sound":
            self.sound.append((message["media_time"], message["packet"]))
        elif message["type"] == "frames":
            self.frames += [message["media_time"] + time for time, _ in message["frames"]]
            if self.sound and self.frames[-1] - self.frames[0] > 1000 * LENGTH - 100:
                self.still.set()


def since(first, timed):
    return [(time - first, packet) for time, packet in timed]


def eventually(holds):
    end = time.monotonic() + PATIENCE
    while not holds() and time.monotonic() < end:
        time.sleep(0.05)
    return holds()


def heard_while(port, start):
    """What a listener of a new stream hears of what `start` plays into it."""
    stream = json.loads(ask(port, "POST", "/v1/streams", {}))["id"]
    listener = Listener(port, stream)
    listener.start()
    result = start(stream)
    assert listener.still.wait(PATIENCE), "it is not heard to its end"
    # Its last packets come after its last frame.
    eventually(lambda: json.loads(ask(port, "GET", f"/v1/streams/{stream}")).get("playing") is None)
    return stream, listener, result


def test(port):
    said = speech(port)

    def record_and_speak(stream):
        recording = json.loads(ask(port, "POST", f"/v1/streams/{stream}/recordings", {}))["id"]
        ask(port, "POST", f"/v1/streams/{stream}/speech", {"speech": said})
        return recording

    stream, listener, recording = heard_while(port, record_and_speak)
    ask(port, "POST", f"/v1/recordings/{recording}/stop")
    content = f"/v1/recordings/{recording}/content"
    header, frames, sound = read_recording(ask(port, "GET", content + "?format=recording"))
    first = frames[0][0]
    assert header["sound"] == listener.header["sound"], header
    assert first == listener.frames[0], (first, listener.frames[0])

    def heard():
        return [(at, packet) for at, packet in listener.sound if at >= first]  # a late player may leave out its first frame

    assert eventually(lambda: heard() == sound) and len(sound) > 20, (len(sound), len(heard()))
    times = [at - first for at, _ in sound]
    assert max(b - a for a, b in zip(times, times[1:])) >= 300, f"the pause is none: {times}"

    # The export has each packet at its time, also of a part.
    for begin in (0, 700):
        exported = read_ogg_opus(ask(port, "GET", f"{content}?format=opus&from={begin}"))
        packets = {packet: ms for ms, packet in exported}
        wanted = [(at - first - begin, packet) for at, packet in sound if at - first >= begin]
        assert wanted
        for at, packet in wanted:
            assert packet in packets and abs(packets[packet] - at) <= 2.5, (begin, at, packets.get(packet))

    # Played into another stream it is heard at the same distances from its frames.
    _, again, _ = heard_while(port, lambda other: ask(port, "POST", f"/v1/streams/{other}/plays", {"recording": recording}))
    replayed, recorded = since(again.frames[0], again.sound), since(first, sound)
    assert len(replayed) > 20  # a late player leaves packets out
    for moment, packet in replayed:
        assert any(packet == other and abs(moment - at) <= 1 for at, other in recorded), (moment, replayed, recorded)

    # A recording without sound says so.
    silent = json.loads(ask(port, "POST", f"/v1/streams/{stream}/recordings", {}))["id"]
    ask(port, "POST", f"/v1/streams/{stream}/frames", {"frames": [{"faps": {"3": 100}}]})
    ask(port, "POST", f"/v1/recordings/{silent}/stop")
    _, frames, none = read_recording(ask(port, "GET", f"/v1/recordings/{silent}/content?format=recording"))
    assert len(frames) == 1 and none == []
    code, detail = refusal(port, f"/v1/recordings/{silent}/content?format=opus")
    assert code == 409 and "no sound" in detail, (code, detail)
    print(f"{len(sound)} packets the same: heard, recorded, exported and played again")


with tempfile.TemporaryDirectory() as data:
    server = subprocess.Popen([sys.argv[1], "serve", "--port", "0", "--data", data], stdout=subprocess.PIPE, text=True)
    try:
        line = server.stdout.readline()
        assert line.startswith("semblante listening on http://"), line
        test(int(line.rsplit(":", 1)[1]))
    finally:
        server.terminate()
        server.wait(PATIENCE)
