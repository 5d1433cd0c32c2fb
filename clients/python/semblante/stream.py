"""A stream: the protocol's state machine, which moves no bytes by itself."""

import ctypes
import enum
from typing import Iterator, List, Optional, Sequence, Tuple, Union

from ._library import library
from ._structs import Clock, Event, Frame, Header, StreamOptions, TimedFrame
from .errors import Owner, check, make

SUBPROTOCOL = "semblante.v1"


class EventType(enum.IntEnum):
    STATE = 1
    CONNECT = 2
    CLOSE = 3
    HEADER = 4
    KEYFRAME = 5
    FRAMES = 6
    CLOCK = 7
    REFUSED = 8
    FAULT = 9
    END = 10
    SOUND = 11
    TEXT = 12


class State(enum.IntEnum):
    CLOSED = 0
    CONNECTING = 1
    OPEN = 2
    WAITING = 3


class VoiceState(enum.IntEnum):
    REACHED = 0
    ENDED = 1
    FAILED = 2
    READY = 3


class Stream(Owner):
    """One stream across connections: bytes and times go in, events and bytes to send come out. `now`: ms of a steady clock.
    `semblante.follow` is a ready loop around it."""

    _destroy = library.semblante_stream_destroy

    def __init__(self, *, publish: bool = False, take_over: bool = False, batch: float = 0.0, seed: int = 0,
                 ping_interval: float = 0.0, resume: Optional[Tuple[int, int]] = None, sound: bool = False,
                 text: bool = False, captions: bool = False) -> None:
        """`batch`: a publisher's frames of this many ms travel in one message. `resume`: what `resume_point` of an earlier
        object gave. `sound`: SOUND events bring the packets of the stream's sound, or this publisher sends them. `text`: this
        client has a voice of its own, and TEXT events come in place of frames and sound of speech. `captions`: they come
        beside them."""
        epoch, sequence = resume or (0, 0)
        options = StreamOptions(role=int(publish), take_over=int(take_over), batch=batch, seed=seed,
                                ping_interval=ping_interval, resume_epoch=epoch, resume_sequence=sequence, sound=int(sound),
                                text=int(text), captions=int(captions))
        super().__init__(make(library.semblante_stream_create, ctypes.byref(options)))

    def start(self, now: float) -> None:
        library.semblante_stream_start(self._handle, now)

    def stop(self, now: float) -> None:
        library.semblante_stream_stop(self._handle, now)

    def opened(self, now: float) -> None:
        """The WebSocket is open."""
        library.semblante_stream_opened(self._handle, now)

    def receive(self, message: bytes, now: float) -> None:
        """One binary message of the server."""
        check(library.semblante_stream_receive(self._handle, message, len(message), now))

    def closed(self, code: int, now: float) -> None:
        """The connection is closed, lost, or could not be opened; `code` 0 if there is none."""
        library.semblante_stream_closed(self._handle, code, now)

    def tick(self, now: float) -> None:
        library.semblante_stream_tick(self._handle, now)

    @property
    def wake_time(self) -> float:
        """When `tick` has something to do; infinity: never."""
        return float(library.semblante_stream_wake_time(self._handle))

    @property
    def state(self) -> State:
        return State(library.semblante_stream_get_state(self._handle))

    def take_bytes(self) -> Optional[bytes]:
        """The next message to send; None when there is none."""
        size = ctypes.c_size_t()
        address = library.semblante_stream_take_bytes(self._handle, ctypes.byref(size))
        return ctypes.string_at(address, size.value) if address else None

    def next_event(self) -> Optional[Event]:
        """The next Event, None when there is none; its `type` is an EventType."""
        event = Event()
        return event if library.semblante_stream_next_event(self._handle, ctypes.byref(event)) else None

    @staticmethod
    def packet(event: Event) -> bytes:
        """The bytes of a SOUND event, before the next event is taken; they begin at its `media_time` and last `duration` ms."""
        return ctypes.string_at(event.packet, event.packet_size) if event.packet_size else b""

    @staticmethod
    def text(event: Event) -> Tuple[str, str, bytes]:
        """The text, language and score of a TEXT event, before the next event is taken; its number is `sequence`."""
        return event.text.decode(), event.language.decode(), Stream.packet(event)

    def spoken(self, state: VoiceState, now: float, speech: int = 0, character: int = 0) -> None:
        """What the client's own voice does, a VoiceState: at a character of the text with that number, or in general."""
        check(library.semblante_stream_spoken(self._handle, state, speech, character, now))

    def set_captions(self, on: bool) -> None:
        """Whether TEXT events come beside frames and sound of speech; also after a new connection."""
        check(library.semblante_stream_set_captions(self._handle, int(on)))

    @staticmethod
    def word_times(event: Event) -> List[float]:
        """When the words of the text of a TEXT event begin, ms after its `media_time`: those between spaces, tabs and ends of
        lines. Before the next event is taken."""
        count = ctypes.c_uint32(2 * event.packet_size)
        times = (ctypes.c_double * max(1, count.value))()
        check(library.semblante_score_words(event.packet, event.packet_size, times, ctypes.byref(count)))
        return times[:count.value]

    def events(self) -> Iterator[Event]:
        while (event := self.next_event()) is not None:
            yield event

    def frames(self) -> List[TimedFrame]:
        """Copies of the frames of the newest KEYFRAME or FRAMES event, as TimedFrame with absolute media times."""
        count = ctypes.c_uint32()
        first = library.semblante_stream_frames(self._handle, ctypes.byref(count))
        return [TimedFrame.from_buffer_copy(first[i]) for i in range(count.value)]

    def header(self) -> Optional[Header]:
        """The newest Header; None before the first."""
        header = Header()
        if library.semblante_stream_header(self._handle, ctypes.byref(header)) != 0:
            return None
        return header

    def clock(self, now: float) -> Optional[Clock]:
        """What is known of the stream's clock; None before the first message with a time."""
        clock = Clock()
        if library.semblante_stream_clock(self._handle, now, ctypes.byref(clock)) != 0:
            return None
        return clock

    def measure_clock(self, now: float) -> None:
        library.semblante_stream_measure_clock(self._handle, now)

    @property
    def resume_point(self) -> Tuple[int, int]:
        """(epoch, sequence) of the last frame received; (0, 0): none."""
        epoch, sequence = ctypes.c_uint64(), ctypes.c_uint64()
        library.semblante_stream_resume_point(self._handle, ctypes.byref(epoch), ctypes.byref(sequence))
        return epoch.value, sequence.value

    def publish(self, frames: Union[Frame, Sequence[TimedFrame]], now: float, media_time: float = 0.0) -> None:
        """Publishes TimedFrames, or one Frame for now. Raises SemblanteError "unavailable" while the stream is not open."""
        if isinstance(frames, Frame):
            frames = [TimedFrame(0.0, frames)]
        block = (TimedFrame * len(frames))(*frames)
        check(library.semblante_stream_publish(self._handle, block, len(frames), media_time, now))

    def publish_sound(self, packet: bytes, media_time: float) -> None:
        """Publishes one Opus packet, heard from `media_time` on, on the clock of the frames; for a publisher with `sound`."""
        check(library.semblante_stream_publish_sound(self._handle, packet, len(packet), media_time))
