"""Follows a running server's stream `demo` in both forms at once, by the independent reader.

Usage: stream_live_test.py PATH_OF_SEMBLANTE (which it starts), or --port N of one that runs with --demo."""

import subprocess
import sys
import tempfile
import threading

from stream_client import StreamClient

FRAMES = 75  # that each form must have had at least, of all that are compared
PATIENCE = 600  # seconds; only a hang lasts so long, on however busy a machine


class Follower(threading.Thread):
    """Collects from one connection: numbers with what was said of them, and the messages around. Goes on until it has
    `least` frames, and all that are compared have `enough` of each other."""

    def __init__(self, port, form, least=FRAMES, enough=lambda: True, **hello):
        super().__init__(daemon=True)
        self.least, self.enough, self.next = least, enough, None
        self.client = StreamClient(port, "demo", as_json=form == "json")
        self.form, self.frames, self.keyframes, self.pongs, self.failure = form, {}, [], [], None
        self.client.say("hello", version=1, **hello)
        self.header = self.client.hear()
        assert self.header["type"] == "header", self.header

    def run(self):
        try:
            self.follow()
        except Exception as failure:  # shown by who waits
            self.failure = f"{self.form}: {failure!r}"

    def follow(self):
        for i in range(3):
            self.client.say("ping", id=i + 1, client_time=i + 0.5)
        while len(self.frames) < self.least or len(self.pongs) < 3 or not self.enough():
            self.take(self.client.hear())

    def take(self, message):
        kind = message["type"]
        if kind == "keyframe":
            self.keyframes.append(message)
            self.next = message["sequence"] + 1
        elif kind == "frames":
            assert message["sequence"] == self.next, f"{message['sequence']}, not {self.next}"
            self.next += len(message["frames"])
            for i, (time, face) in enumerate(message["frames"]):
                self.frames[message["sequence"] + i] = (message["media_time"] + time, face)
        elif kind == "pong":
            self.pongs.append(message)
        else:
            raise AssertionError(message)


def all_of(followers):
    for follower in followers:
        follower.join(PATIENCE)
        assert follower.failure is None, follower.failure
        assert not follower.is_alive(), f"{follower.form}: {len(follower.frames)} frames after {PATIENCE} s"


def in_common(followers):
    return set.intersection(*(set(f.frames) for f in followers))


def same_frames(followers, least):
    common = in_common(followers)
    assert len(common) >= least, f"{len(common)} frames in common"
    for number in common:
        said = {f.frames[number] for f in followers}
        assert len(said) == 1, f"frame {number}: {said}"
    return len(common)


def test(port):
    forms = ("binary", "json")
    first, second = [], []

    def enough():
        return len(second) == len(forms) and len(in_common(first)) >= FRAMES // 2 and len(in_common(first + second)) >= 10

    first += [Follower(port, form, enough=enough) for form in forms]
    for follower in first:
        follower.start()
    while first[0].is_alive() and len(first[0].frames) < FRAMES // 3:
        first[0].join(0.05)
    second += [Follower(port, form, enough=enough) for form in forms]  # in the middle of what the first ones get
    for follower in second:
        follower.start()
    all_of(first + second)
    compared = same_frames(first, FRAMES // 2)
    same_frames(first + second, 10)

    everything = {number: said for follower in first + second for number, said in follower.frames.items()}
    for follower in first + second:
        header, key = follower.header, follower.keyframes[0]
        assert header["stream"] == "demo" and header["version"] == 1
        assert key["sequence"] == min(follower.frames) - 1, (key["sequence"], min(follower.frames))
        if key["sequence"] in everything:
            assert everything[key["sequence"]] == (key["media_time"], key["state"]), key
        times = [follower.frames[number][0] for number in sorted(follower.frames)]
        assert times == sorted(times), "media time fell"
        assert {(p["id"], p["client_time"]) for p in follower.pongs} == {(1, 0.5), (2, 1.5), (3, 2.5)}, follower.pongs
        assert all(p["media_time"] >= header["media_time"] for p in follower.pongs)

    # Back after a loss, by a point of this epoch and by one of another.
    for form in forms:
        before = Follower(port, form, 10)
        before.start()
        all_of([before])
        before.client.close()
        point = {"epoch": before.header["epoch"], "sequence": max(before.frames)}
        back = Follower(port, form, 10, resume=point)
        back.start()
        all_of([back])
        assert back.header["recovered"] and back.keyframes[0]["sequence"] == point["sequence"], (back.header, point)
        assert (back.keyframes[0]["media_time"], back.keyframes[0]["state"]) == before.frames[point["sequence"]]
        assert min(back.frames) == point["sequence"] + 1
        back.client.close()
        other = Follower(port, form, resume={"epoch": before.header["epoch"] + 1, "sequence": 1})
        assert not other.header["recovered"], other.header
        other.client.close()
    errors(port)
    print(f"{compared} frames the same in {', '.join(forms)}; joined, resumed, answered")


def errors(port):
    """Bytes that are no message are answered, and the connection goes on."""
    client = StreamClient(port, "demo")
    client.say("hello", version=1)
    client.hear()
    client.send_frame(2, b"\x7f")
    client.send_frame(2, b"\x07\x80")
    client.say("ping", id=9, client_time=0)
    heard = []
    while not heard or heard[-1]["type"] != "pong":
        heard.append(client.hear())
    said = [(m["code"], m["where"]) for m in heard if m["type"] == "error"]
    assert said == [("unsupported", "/type"), ("truncated", "/id")], said


if sys.argv[1] == "--port":
    test(int(sys.argv[2]))
else:
    with tempfile.TemporaryDirectory() as data:
        server = subprocess.Popen([sys.argv[1], "serve", "--demo", "--port", "0", "--data", data], stdout=subprocess.PIPE, text=True)
        try:
            line = server.stdout.readline()
            assert line.startswith("semblante listening on http://"), line
            test(int(line.rsplit(":", 1)[1]))
        finally:
            server.terminate()
            server.wait(PATIENCE)
