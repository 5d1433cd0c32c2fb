"""A WebSocket client of RFC 6455 for streams, on a plain socket, and what section 3 of protocol/SPEC.md lets a client say."""

import base64
import contextlib
import hashlib
import json
import os
import socket
import struct

from stream_reader import ENUMS, NAMED, SCHEMA, Reader, appended, default

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


class Closed(Exception):
    """By the other side: `code` is that of its close frame, None if it said none."""

    def __init__(self, code):
        super().__init__(f"closed with {code}")
        self.code = code


def varint(value):
    out = b""
    while value > 127:
        out += bytes([value & 127 | 128])
        value >>= 7
    return out + bytes([value])


def written(fields, values):
    """Binary form of those fields that a client's messages have."""
    last = max((i for i, f in enumerate(fields) if not appended(f) or values.get(f["name"], default(f)) != default(f)), default=-1)
    out = b""
    for field in fields[: last + 1]:
        value = values.get(field["name"], default(field))
        if field["type"] == "uint":
            out += varint(value)
        elif field["type"] == "real":
            out += struct.pack("<d", value)
        elif field["type"] == "enum":
            out += bytes([[v["name"] for v in ENUMS[field["enum"]]["values"]].index(value)])
        elif field["type"] == "bool":
            out += bytes([value])
        else:  # the resume point
            out += b"\0" if value is None else b"\1" + varint(value["epoch"]) + varint(value["sequence"])
    return out


class StreamClient:
    """One connection to a stream, in the JSON or the binary form."""

    def __init__(self, port, stream, as_json=False, timeout=600):
        self.as_json, self.reader, self.header, self.waiting = as_json, Reader(), None, b""
        self.socket = socket.create_connection(("127.0.0.1", port), timeout)
        key = base64.b64encode(os.urandom(16)).decode()
        protocol = SCHEMA["subprotocols"]["json" if as_json else "binary"]
        self.socket.sendall(
            f"GET /v1/streams/{stream} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: {protocol}\r\n\r\n".encode())
        while b"\r\n\r\n" not in self.waiting:
            self._more()
        head, self.waiting = self.waiting.split(b"\r\n\r\n", 1)
        lines = head.decode("latin-1").split("\r\n")
        fields = {name.lower(): value.strip() for name, value in (line.split(":", 1) for line in lines[1:])}
        accept = hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest()
        if lines[0].split()[1] != "101" or base64.b64decode(fields["sec-websocket-accept"]) != accept:
            raise ConnectionError(lines[0])
        if fields.get("sec-websocket-protocol") != protocol:
            raise ConnectionError("not the subprotocol that was asked for")

    def _more(self):
        piece = self.socket.recv(65536)
        if not piece:
            raise Closed(None)
        self.waiting += piece

    def _take(self, count):
        while len(self.waiting) < count:
            self._more()
        taken, self.waiting = self.waiting[:count], self.waiting[count:]
        return taken

    def _frame(self):
        first, length = self._take(2)
        if length == 126:
            length = struct.unpack(">H", self._take(2))[0]
        elif length == 127:
            length = struct.unpack(">Q", self._take(8))[0]
        return first >> 7, first & 15, self._take(length)  # a server does not mask

    def send_frame(self, opcode, payload):
        mask = os.urandom(4)
        size = len(payload)
        length = bytes([128 | size]) if size < 126 else b"\xfe" + struct.pack(">H", size) if size < 65536 else b"\xff" + struct.pack(">Q", size)
        self.socket.sendall(bytes([128 | opcode]) + length + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(payload)))

    def say(self, name, **values):
        """A message of a client but keyframe and frames: hello, ping, end."""
        if self.as_json:
            self.send_frame(TEXT, json.dumps({"type": name, **values}).encode())
        else:
            self.send_frame(BINARY, bytes([NAMED[name]["type"]]) + written(NAMED[name]["fields"], values))

    def hear(self):
        """The next message; Closed when there is none."""
        message, of = b"", None
        while True:
            final, opcode, payload = self._frame()
            if opcode == PING:
                self.send_frame(PONG, payload)
            elif opcode == CLOSE:
                with contextlib.suppress(OSError):  # it need not wait for the answer
                    self.send_frame(CLOSE, payload)
                raise Closed(struct.unpack(">H", payload[:2])[0] if payload else None)
            elif opcode != PONG:
                of, message = of or opcode, message + payload
                if final:
                    break
        assert of == (TEXT if self.as_json else BINARY)
        read = self.reader.text(message.decode()) if self.as_json else self.reader.binary(message)
        self.header = read if read["type"] == "header" else self.header
        return read

    def close(self):
        self.socket.close()
