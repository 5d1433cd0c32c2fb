"""A WebSocket client (RFC 6455) on a blocking socket of the standard library: messages in, messages out.

Kept small on purpose: text and binary messages, ping and pong, close, TLS. No extensions, no proxies. A program that has
a WebSocket of its own (asyncio, a framework) does not need this module: `Stream` takes and gives bytes.
"""

import base64
import hashlib
import os
import selectors
import socket
import ssl
import struct
import urllib.parse
from typing import Mapping, Optional, Sequence, Tuple, Union

_accept_suffix = b"258EAFA5-E914-47DA-95CA-C5AB0DC85B11"
_continuation, _text, _binary, _close, _ping, _pong = 0, 1, 2, 8, 9, 10


class WebSocketError(OSError):
    """The connection could not be made, or the other side broke the protocol. `status`: of a refused handshake, else 0."""

    def __init__(self, message: str, status: int = 0) -> None:
        super().__init__(message)
        self.status = status


class Closed(WebSocketError):
    """The connection has ended. `code`: the close code, 1006 when the connection was lost without one."""

    def __init__(self, code: int, reason: str = "") -> None:
        super().__init__(f"closed with {code}" + (f": {reason}" if reason else ""))
        self.code = code
        self.reason = reason


class WebSocket:
    """A connection to `url` (ws, wss, http or https). Raises WebSocketError, or OSError of the socket."""

    def __init__(self, url: str, subprotocols: Sequence[str] = (), *, headers: Optional[Mapping[str, str]] = None,
                 timeout: float = 10.0, ssl_context: Optional[ssl.SSLContext] = None, max_message: int = 1 << 20) -> None:
        parts = urllib.parse.urlsplit(url)
        secure = parts.scheme in ("wss", "https")
        if parts.scheme not in ("ws", "wss", "http", "https") or not parts.hostname:
            raise ValueError(f"not the address of a WebSocket: {url}")
        port = parts.port or (443 if secure else 80)
        self.max_message = max_message
        self._held = bytearray()  # bytes received, not yet parsed
        self._parts = bytearray()  # of a message in several frames
        self._kind: Optional[int] = None
        self._socket: socket.socket = socket.create_connection((parts.hostname, port), timeout)
        try:
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            if secure:
                context = ssl_context or ssl.create_default_context()
                self._socket = context.wrap_socket(self._socket, server_hostname=parts.hostname)
            self._shake_hands(parts, port, secure, subprotocols, headers or {})
        except BaseException:
            self._socket.close()
            raise

    def _shake_hands(self, parts: urllib.parse.SplitResult, port: int, secure: bool, subprotocols: Sequence[str],
                     headers: Mapping[str, str]) -> None:
        name = parts.hostname or ""
        host = f"[{name}]" if ":" in name else name
        if port != (443 if secure else 80):
            host += f":{port}"
        key = base64.b64encode(os.urandom(16))
        target = (parts.path or "/") + (f"?{parts.query}" if parts.query else "")
        lines = [f"GET {target} HTTP/1.1", f"Host: {host}", "Upgrade: websocket", "Connection: Upgrade",
                 f"Sec-WebSocket-Key: {key.decode()}", "Sec-WebSocket-Version: 13"]
        if subprotocols:
            lines.append("Sec-WebSocket-Protocol: " + ", ".join(subprotocols))
        for name, value in headers.items():
            if any(c in f"{name}{value}" for c in "\r\n"):
                raise ValueError(f"header {name!r} has a line break")
            lines.append(f"{name}: {value}")
        self._socket.sendall(("\r\n".join(lines) + "\r\n\r\n").encode("latin-1"))
        while b"\r\n\r\n" not in self._held:
            if len(self._held) > 65536:
                raise WebSocketError("the answer to the handshake is longer than 64 KiB")
            self._read_more()
        head, self._held = self._held.split(b"\r\n\r\n", 1)
        first, *rest = head.decode("latin-1").split("\r\n")
        words = first.split(" ", 2)
        if len(words) < 2 or not words[1].isdecimal():
            raise WebSocketError("the other side does not speak HTTP")
        if words[1] != "101":
            raise WebSocketError(f"the server refused the WebSocket: {' '.join(words[1:])}", int(words[1]))
        fields = {name.strip().lower(): value.strip() for name, _, value in (line.partition(":") for line in rest)}
        wanted = base64.b64encode(hashlib.sha1(key + _accept_suffix).digest()).decode()
        if fields.get("sec-websocket-accept") != wanted:
            raise WebSocketError("the answer to the handshake belongs to another request")
        self.subprotocol = fields.get("sec-websocket-protocol")

    def fileno(self) -> int:
        return self._socket.fileno()

    def send(self, message: Union[str, bytes]) -> None:
        """Sends bytes as a binary message, str as a text message."""
        if isinstance(message, str):
            self._send_frame(_text, message.encode())
        else:
            self._send_frame(_binary, bytes(message))

    def _send_frame(self, kind: int, payload: bytes) -> None:
        size = len(payload)
        head = bytes([0x80 | kind])
        if size < 126:
            head += bytes([0x80 | size])
        elif size < 65536:
            head += struct.pack(">BH", 0x80 | 126, size)
        else:
            head += struct.pack(">BQ", 0x80 | 127, size)
        mask = os.urandom(4)
        pattern = (mask * (size // 4 + 1))[:size]
        masked = (int.from_bytes(payload, "big") ^ int.from_bytes(pattern, "big")).to_bytes(size, "big")
        self._socket.sendall(head + mask + masked)

    def receive(self, timeout: Optional[float] = None) -> Optional[Union[str, bytes]]:
        """The next message, bytes or str; None when none arrived within `timeout` seconds. Raises Closed at the end."""
        while True:
            message = self._next_message()
            if message is not None:
                return message
            # Bytes that TLS has decrypted already are not seen by a selector.
            pending = getattr(self._socket, "pending", lambda: 0)()
            if not pending and timeout is not None and not self._arrives_within(timeout):
                return None
            self._read_more()

    def _arrives_within(self, timeout: float) -> bool:
        # Not `select`: it refuses the sockets of a program that has more than 1024 files open.
        with selectors.DefaultSelector() as selector:
            selector.register(self._socket, selectors.EVENT_READ)
            return bool(selector.select(timeout))

    def _read_more(self) -> None:
        try:
            got = self._socket.recv(65536)
        except ConnectionError as error:
            raise Closed(1006, str(error)) from error
        if not got:
            raise Closed(1006, "the connection was lost")
        self._held += got

    def _next_message(self) -> Optional[Union[str, bytes]]:
        """A whole message of the bytes held; None when there is none yet. Answers pings on the way."""
        while True:
            frame = self._next_frame()
            if frame is None:
                return None
            is_last, kind, payload = frame
            if kind == _ping:
                self._send_frame(_pong, payload)
            elif kind == _close:
                code = int.from_bytes(payload[:2], "big") if len(payload) >= 2 else 1005
                try:
                    self._send_frame(_close, payload[:2])
                except OSError:
                    pass
                raise Closed(code, payload[2:].decode("utf-8", "replace"))
            elif kind in (_text, _binary, _continuation):
                if (kind == _continuation) != (self._kind is not None):
                    raise WebSocketError("a message begins within another one")
                self._kind = kind if self._kind is None else self._kind
                self._parts += payload
                if len(self._parts) > self.max_message:
                    raise WebSocketError(f"a message is longer than {self.max_message} bytes")
                if is_last:
                    message, is_text = bytes(self._parts), self._kind == _text
                    self._parts.clear()
                    self._kind = None
                    return self._text_of(message) if is_text else message

    @staticmethod
    def _text_of(message: bytes) -> str:
        try:
            return message.decode()
        except UnicodeDecodeError as error:
            raise WebSocketError("the server sent a text that is not UTF-8") from error

    def _next_frame(self) -> Optional[Tuple[bool, int, bytes]]:
        held = self._held
        if len(held) < 2:
            return None
        kind, size, at = held[0] & 15, held[1] & 127, 2
        if held[0] & 0x70 or held[1] & 0x80 or kind not in (_continuation, _text, _binary, _close, _ping, _pong):
            raise WebSocketError("the server sent a frame that RFC 6455 does not allow")
        if size == 126:
            at, size = 4, int.from_bytes(held[2:4], "big") if len(held) >= 4 else 0
        elif size == 127:
            at, size = 10, int.from_bytes(held[2:10], "big") if len(held) >= 10 else 0
        if size > self.max_message:
            raise WebSocketError(f"a frame is longer than {self.max_message} bytes")
        if len(held) < at + size:
            return None
        frame = (held[0] & 0x80 != 0, kind, bytes(held[at:at + size]))
        del held[:at + size]
        return frame

    def close(self, code: int = 1000) -> None:
        """Says goodbye and closes; does not wait for the answer."""
        try:
            self._send_frame(_close, code.to_bytes(2, "big"))
        except OSError:
            pass
        self._socket.close()
