const longestPacket = 120;

/** How long an Opus packet lasts, ms, by its first two bytes (RFC 6716, sections 3.1 and 3.2); null: it is none. */
export function opusPacketMs(packet: Uint8Array): number | null {
  const [first, second] = packet;
  if (first === undefined) return null;
  const code = first & 3;
  if (code === 3 && second === undefined) return null;
  const frames = code === 0 ? 1 : code < 3 ? 2 : second! & 63;
  const configuration = first >> 3;
  const frame =
    configuration < 12
      ? [10, 20, 40, 60][configuration % 4]!
      : configuration < 16
        ? [10, 20][configuration % 2]!
        : [2.5, 5, 10, 20][configuration % 4]!;
  const ms = frames * frame;
  return ms > 0 && ms <= longestPacket ? ms : null;
}
