"""A server: fetching a face package, and following a stream over a blocking WebSocket."""

import json
import math
import os
import ssl
import time
import urllib.error
import urllib.parse
import urllib.request
from typing import Any, Iterator, List, Optional

from ._structs import Event
from .errors import SemblanteError
from .head import Head
from .player import Player
from .stream import SUBPROTOCOL, EventType, Stream
from .websocket import Closed, WebSocket, WebSocketError

_largest_part = 256 << 20
_largest_problem = 64 << 10


def now() -> float:
    """ms of a steady clock."""
    return time.monotonic() * 1000.0


def _token(token: Optional[str]) -> Optional[str]:
    return os.environ.get("SEMBLANTE_TOKEN") if token is None else token


def _words(error: urllib.error.HTTPError) -> str:
    """What a problem document says, with the name of what helps; else what the status means."""
    try:
        problem = json.loads(error.read(_largest_problem))
        detail, advice = problem["detail"], problem.get("advice")
    except (OSError, ValueError, LookupError, TypeError, AttributeError):
        return str(error.reason)
    if not isinstance(detail, str):
        return str(error.reason)
    return f"{detail} ({advice})" if isinstance(advice, str) else detail


def _base(server: str) -> str:
    """The address of a server without its last slash."""
    try:
        parts = urllib.parse.urlsplit(server)
        is_address = parts.scheme in ("http", "https") and bool(parts.hostname) and parts.port != 0
    except ValueError:  # of the port
        is_address = False
    if not is_address:
        raise ValueError(f"server {server!r} is no address such as http://127.0.0.1:8080")
    return server.rstrip("/")


def fetch_head(server: str, model: str, *, lod: Optional[int] = None, max_vertices: Optional[int] = None,
               token: Optional[str] = None, ssl_context: Optional[ssl.SSLContext] = None, timeout: float = 30.0,
               **options: Any) -> Head:
    """The Head of a model: `fetch_head("http://127.0.0.1:8080", "sample")`. `lod` or `max_vertices` select a level of detail.
    `token`: default SEMBLANTE_TOKEN of the environment. `options`: those of Head. Raises urllib.error.URLError,
    SemblanteError."""
    query = {name: value for name, value in (("lod", lod), ("max_vertices", max_vertices)) if value is not None}
    folder = f"{_base(server)}/v1/models/{urllib.parse.quote(model, safe='')}"
    suffix = "?" + urllib.parse.urlencode(query) if query else ""
    token = _token(token)

    def part(name: str) -> bytes:
        request = urllib.request.Request(f"{folder}/{name}{suffix}")
        if token:
            request.add_header("Authorization", f"Bearer {token}")
        try:
            with urllib.request.urlopen(request, timeout=timeout, context=ssl_context) as answer:
                content: bytes = answer.read(_largest_part + 1)
        except urllib.error.HTTPError as error:
            raise urllib.error.HTTPError(error.url, error.code, _words(error), error.headers, None) from error
        if len(content) > _largest_part:
            raise SemblanteError("too_large", name, f"is larger than {_largest_part} bytes")
        return content

    for attempt in (1, 2):
        try:
            return Head(part("mesh.drc"), part("weights"), part("rig.json"), **options)
        except SemblanteError as error:
            # The package may have been replaced between the requests.
            if error.code != "mismatch" or attempt == 2:
                raise
    raise AssertionError("unreachable")


class Connection:
    """A Stream with its WebSocket. Call `poll` often: it reconnects, sends what is due and returns events."""

    def __init__(self, server: str, stream: str, *, token: Optional[str] = None,
                 ssl_context: Optional[ssl.SSLContext] = None, connect_timeout: float = 5.0, **options: Any) -> None:
        """`options`: those of Stream."""
        self.url = f"{_base(server)}/v1/streams/{urllib.parse.quote(stream, safe='')}"
        self.stream = Stream(seed=int.from_bytes(os.urandom(8), "little"), **options)
        self._token = _token(token)
        self._ssl_context = ssl_context
        self._connect_timeout = connect_timeout
        self._socket: Optional[WebSocket] = None
        self._was_open = False
        self.stream.start(now())

    def poll(self, timeout: float = 0.0) -> List[Event]:
        """Waits up to `timeout` seconds for a message and returns the events since the last call. Raises WebSocketError when
        the server refuses for good: no such stream (404), no rights (401, 403), not its name (421); it and OSError when the
        first connection cannot be made. A further call tries again. A connection that was made once is made again without
        an error."""
        events = self._settle()
        if events or self._socket is None:
            if not events:
                time.sleep(min(timeout, max(0.0, (self.stream.wake_time - now()) / 1000.0)))
                self.stream.tick(now())
                events = self._settle()
            return events
        wait = min(timeout, max(0.0, (self.stream.wake_time - now()) / 1000.0))
        try:
            message = self._socket.receive(wait)
            while message is not None:
                if isinstance(message, bytes):
                    self.stream.receive(message, now())
                events += self._settle()
                message = self._socket.receive(0.0) if self._socket else None
        except Closed as closed:
            self._lose(closed.code)
        except OSError:
            self._lose(1006)
        self.stream.tick(now())
        return events + self._settle()

    def _settle(self) -> List[Event]:
        """Does what the stream asks for, until it asks for nothing; the events on the way."""
        events: List[Event] = []
        while True:
            event = self.stream.next_event()
            if event is None:
                if not self._send():
                    return events
                continue
            events.append(event)
            if event.type == EventType.CONNECT:
                self._connect()
            elif event.type == EventType.CLOSE and self._socket:
                self._socket.close(event.code or 1000)
                self._lose(event.code)

    def _connect(self) -> None:
        headers = {"Authorization": f"Bearer {self._token}"} if self._token else {}
        try:
            self._socket = WebSocket(self.url, [SUBPROTOCOL], headers=headers, timeout=self._connect_timeout,
                                     ssl_context=self._ssl_context)
        except (WebSocketError, OSError) as error:
            self.stream.closed(0, now())
            if not self._may_pass(error):
                raise
        else:
            self._was_open = True
            self.stream.opened(now())

    def _may_pass(self, error: Exception) -> bool:
        """Whether to connect again without a word: a server that is busy or has stopped, but not one that refuses, or was
        never there: then the address is wrong, or its certificate is not accepted."""
        status = getattr(error, "status", None)
        if status is not None:
            return status in (408, 425, 429) or status >= 500
        return self._was_open

    def _send(self) -> bool:
        """Sends what waits; False when there was nothing."""
        message = self.stream.take_bytes()
        if message is None:
            return False
        if self._socket:
            try:
                self._socket.send(message)
            except OSError:
                self._lose(1006)
        return True

    def _lose(self, code: int) -> None:
        if self._socket:
            self._socket.close()
            self._socket = None
        self.stream.closed(code, now())

    def close(self) -> None:
        self.stream.stop(now())
        self._settle()
        if self._socket:
            self._socket.close()
            self._socket = None

    def __enter__(self) -> "Connection":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def follow(server: str, stream: str, *, head: Optional[Head] = None, rate: float = 60.0,
           **options: Any) -> Iterator[Player]:
    """Follows a stream at `rate` display frames per second. Yields a Player for each display frame at which there is something
    to show, after setting the pose of `head`. Ends with the stream. `options`: those of Connection."""
    if not 0.0 < rate < math.inf:
        raise ValueError(f"rate: {rate} is no number of frames per second")
    player = Player()
    step = 1.0 / rate
    with Connection(server, stream, **options) as connection:
        player.follow(connection.stream)
        due = time.monotonic()
        while True:
            due = max(due + step, time.monotonic() - step)
            ended = False
            while True:
                for event in connection.poll(max(0.0, due - time.monotonic())):
                    ended = ended or (event.type == EventType.END and event.is_final)
                if time.monotonic() >= due:
                    break
            if player.advance(now()):
                if head is not None:
                    player.show(head)
                yield player
            if ended:
                return
