#!/usr/bin/env python3
"""What a minute of talk takes on the wire: face, sound, both, text alone, captions beside the face. Python 3, standard library.

    minute.py PROGRAM [TEXT_FILE LANGUAGE]     PROGRAM: build/bin/semblante, with its voice beside it

Starts a server, has a stream say the text, and counts the WebSocket payloads and headers of one subscriber without and one with
sound, of one with a voice of its own, and of one that shows captions, until the talk ends."""

import base64
import contextlib
import http.client
import json
import os
import pathlib
import re
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

TEXT = pathlib.Path(__file__).with_name("talk.txt")


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def ask(port, method, path, body=None):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=120)
    connection.request(method, path, json.dumps(body) if body is not None else None, {"Content-Type": "application/json"} if body is not None else {})
    answer = connection.getresponse()
    return answer.status, json.loads(answer.read() or b"null")


class Subscriber(threading.Thread):
    """Counts what comes; in the binary form a first byte of 10 is sound, 11 or 13 is text, 9 and 128 to 255 are faces."""

    def __init__(self, port, sound=False, text=False, captions=False):
        super().__init__(daemon=True)
        self.bytes = {"face": 0, "sound": 0, "text": 0}
        self.messages = dict(self.bytes)
        self.socket = socket.create_connection(("127.0.0.1", port))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall(
            f"GET /v1/streams/talk HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: semblante.v1\r\n\r\n".encode())
        self.file = self.socket.makefile("rb")
        while self.file.readline() != b"\r\n":
            pass
        hello = bytes([1, 1, 0, 0]) + bytes([0, sound, text, captions]).rstrip(b"\0")
        self.socket.sendall(bytes([0x82, 0x80 | len(hello)]) + bytes(4) + hello)

    def run(self):
        while head := self.file.read(2):
            size, header = head[1] & 127, 2
            if size == 126:
                size, header = struct.unpack(">H", self.file.read(2))[0], 4
            payload = self.file.read(size)
            if head[0] & 15 != 2 or not payload or payload[0] in (2, 5):
                continue
            kind = {10: "sound", 11: "text", 13: "text"}.get(payload[0], "face")
            if kind == "sound":
                self.heard()
            self.bytes[kind] += header + size
            self.messages[kind] += 1


    def heard(self):
        """A packet of sound has come."""


class Server:
    """A server of its own; close() ends it."""

    def __init__(self, program):
        self.port = free_port()
        self.data = tempfile.TemporaryDirectory()
        self.process = subprocess.Popen([program, "serve", "--port", str(self.port), "--data", self.data.name],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for _ in range(600):
            with contextlib.suppress(OSError):
                if ask(self.port, "GET", "/readyz")[0] == 200:
                    return
            time.sleep(0.1)

    def close(self):
        self.process.terminate()
        self.process.wait()
        self.data.cleanup()


def text_of(path):
    return re.sub(r"\s+", " ", pathlib.Path(path).read_text()).strip()


def main(program, text, language):
    with contextlib.closing(Server(program)) as server:
        port = server.port
        assert ask(port, "POST", "/v1/streams", {"name": "talk"})[0] == 201
        subscribers = [Subscriber(port), Subscriber(port, sound=True), Subscriber(port, text=True), Subscriber(port, captions=True)]
        for one in subscribers:
            one.start()
        status, playing = ask(port, "POST", "/v1/streams/talk/speech", {"text": text, "language": language, "seed": 7})
        assert status == 202, playing
        while playing:
            seconds = playing["duration"] / 1000  # of what has been made
            time.sleep(0.5)
            playing = ask(port, "GET", "/v1/streams/talk")[1]["playing"]
        time.sleep(1)  # for subscribers of a busy machine
        without, both, reader, captioned = subscribers
        assert captioned.bytes["face"] == without.bytes["face"], f"captions change the face: {captioned.bytes} {without.bytes}"
        assert without.bytes["sound"] == without.bytes["text"] == both.bytes["text"] == reader.bytes["sound"] == 0
        print(f"{seconds:.1f} s of talk")
        print("| a minute of talk | messages | bytes | kbit/s |\n|---|---|---|---|")
        rows = [("face", without.messages["face"], without.bytes["face"]), ("sound", both.messages["sound"], both.bytes["sound"]),
                ("both", sum(both.messages.values()), sum(both.bytes.values())),
                ("text alone", sum(reader.messages.values()), sum(reader.bytes.values())),
                ("captions beside the face", captioned.messages["text"], captioned.bytes["text"])]
        for name, messages, count in rows:
            print(f"| {name} | {messages * 60 / seconds:.0f} | {count * 60 / seconds:.0f} | {count * 8 / seconds / 1000:.2f} |")
        said = len(text.encode()) * 8 / seconds
        print(f"of the text alone: {reader.messages['text']} sentences, {reader.bytes['text']} bytes; the letters themselves take {said:.0f} bit/s")


if __name__ == "__main__":
    main(sys.argv[1], text_of(sys.argv[2] if len(sys.argv) > 2 else TEXT), sys.argv[3] if len(sys.argv) > 3 else "en")
