"""Reads a recording of a stream and its sound as Ogg/Opus.

Written from server/recordings/README.md, protocol/SPEC.md and RFC 7845 and 3533, alone, as stream_reader.py is."""

import struct
import zlib

from stream_reader import Bytes, Reader, Refused, opus_packet_ms

HEADER, FRAMES, SOUND = 1, 2, 3


def messages_of(data):
    source = Bytes(data)
    while source.at < len(data):
        yield source.take(source.varint("length"), "message")


def read_recording(data):
    """The header, (media time, number, Face) of each frame, and (media time, packet) of each packet of sound."""
    if data[:8] != b"SEMBREC\x02":
        raise Refused("malformed", "byte 0")
    header, frames, sound, at, reader = None, [], [], 8, Reader()
    while at < len(data):
        magic, size, crc, kind, count, lost, first, begin, end = struct.unpack("<4sIIB3xIIQQQ", data[at : at + 48])
        chunk = data[at : at + 48 + size]
        where = f"byte {at}"
        if magic != b"CHNK" or size > 524288 or len(chunk) != 48 + size or zlib.crc32(chunk[12:]) != crc:
            raise Refused("malformed", where)
        said = [reader.binary(message) for message in messages_of(chunk[48:])] if kind in (HEADER, FRAMES, SOUND) else []
        if kind == HEADER:
            (header,) = said
            if header["type"] != "header" or at != 8:
                raise Refused("malformed", where)
        elif kind == FRAMES:
            key, *batches = said
            of_chunk = [(key["media_time"], key["sequence"], key["state"])]
            for batch in batches:
                for i, (time, face) in enumerate(batch["frames"]):
                    of_chunk.append((batch["media_time"] + time, batch["sequence"] + i, face))
            as_said = (of_chunk[0][0], of_chunk[-1][0], of_chunk[0][1], len(of_chunk)) == (begin, end, first, count)
            follows = not frames or (first == frames[-1][1] + 1 + lost and begin >= frames[-1][0])
            if not (as_said and follows):
                raise Refused("malformed", where)
            frames += of_chunk
        elif kind == SOUND:
            of_chunk = [(m["media_time"], m["packet"]) for m in said]
            as_said = (of_chunk[0][0], of_chunk[-1][0], len(of_chunk), first, lost) == (begin, end, count, 0, 0)
            follows = frames and begin >= (sound[-1][0] if sound else frames[0][0])
            if not (as_said and follows and all(m["type"] == "sound" for m in said)):
                raise Refused("malformed", where)
            sound += of_chunk
        at += len(chunk)
    return header, frames, sound


def ogg_crc(page):
    """RFC 3533, 6: polynomial 0x04c11db7, begun with 0, of the page with 0 in place of its checksum."""
    crc = 0
    for byte in page[:22] + b"\0\0\0\0" + page[26:]:
        crc ^= byte << 24
        for _ in range(8):
            crc = (crc << 1 ^ (0x04C11DB7 if crc & 0x80000000 else 0)) & 0xFFFFFFFF
    return crc


def read_ogg_opus(data):
    """(ms after the beginning of the file, packet) of each packet."""
    at, packets, rest, pages, ended = 0, [], b"", 0, False
    while at < len(data):
        magic, version, flags, granule, serial, number, crc, count = struct.unpack("<4sBBqIIIB", data[at : at + 27])
        lacing = data[at + 27 : at + 27 + count]
        page = data[at : at + 27 + count + sum(lacing)]
        sound = (magic, version, number, flags & 3) == (b"OggS", 0, pages, (1 if rest else 0) | (2 if pages == 0 else 0))
        if ended or not sound or ogg_crc(page) != crc:
            raise Refused("malformed", f"byte {at}")
        body = page[27 + count :]
        for length in lacing:
            rest, body = rest + body[:length], body[length:]
            if length < 255:
                packets.append(rest)
                rest = b""
        played = sum(opus_packet_ms(packet) for packet in packets[2:]) * 48
        if granule not in (-1, played):  # an own clock would be a shift of the sound
            raise Refused("mismatch", f"byte {at}: {granule}, not {played}")
        at, pages, ended = at + len(page), pages + 1, bool(flags & 4)
    head, tags, *packets = packets
    preskip, rate, gain, family = struct.unpack("<HIHB", head[10:])
    if head[:9] != b"OpusHead\x01" or tags[:8] != b"OpusTags" or (preskip, gain, family) != (0, 0, 0) or not ended:
        raise Refused("malformed", "the header")
    timed, ms = [], 0
    for packet in packets:
        timed.append((ms, packet))
        ms += opus_packet_ms(packet)
    return timed
