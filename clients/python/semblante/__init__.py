"""Semblante: faces that talk over a thin wire.

    import semblante

    head = semblante.fetch_head("http://127.0.0.1:8080", "sample")
    head.set_frame(semblante.frame({3: 300}, expression=(1, 0.8)))
    vertices = head.positions()                      # #V by 3, numpy if it is installed

    for player in semblante.follow("http://127.0.0.1:8080", "demo", head=head):
        draw(head.positions(), head.triangles)
"""

from ._structs import Frame, Heard, Pose, TimedFrame
from .bridges import ARKIT_NAMES, OCULUS_NAMES, from_arkit, from_oculus, to_arkit, to_oculus
from .errors import SemblanteError
from .head import Head, frame
from .listener import Listener
from .performance import Performance, Take, TakeFormat, write_take
from .player import Player
from .server import Connection, fetch_head, follow, now
from .speaker import Speaker
from .stream import SUBPROTOCOL, EventType, State, Stream, VoiceState
from .websocket import Closed, WebSocket, WebSocketError

__version__ = "0.2.0"

__all__ = [
    "ARKIT_NAMES", "OCULUS_NAMES", "SUBPROTOCOL", "Closed", "Connection", "EventType", "Frame", "Head", "Heard",
    "Listener", "Performance", "Player", "Pose", "SemblanteError", "Speaker", "State", "Stream", "Take", "TakeFormat", "TimedFrame", "VoiceState", "WebSocket", "WebSocketError",
    "fetch_head", "follow", "frame", "from_arkit", "from_oculus", "now", "to_arkit", "to_oculus", "write_take",
]
