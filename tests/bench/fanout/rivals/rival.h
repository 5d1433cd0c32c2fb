#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>

#include "tests/bench/fanout/rivals/payload.h"

namespace semblante::bench::rivals {

struct Arguments {
  double messages_per_second = 25.0;
  std::size_t bytes = 64;
  const char* certificate = nullptr;  ///< PEM files; null: without TLS
  const char* key = nullptr;
};

inline Arguments arguments_of(int count, char** words) {
  Arguments arguments;
  if (count > 1) arguments.messages_per_second = std::atof(words[1]);
  if (count > 2) arguments.bytes = static_cast<std::size_t>(std::atol(words[2]));
  if (count > 4) {
    arguments.certificate = words[3];
    arguments.key = words[4];
  }
  if (!(arguments.messages_per_second > 0.0)) std::exit(2);
  return arguments;
}

inline void announce(unsigned port, const char* scheme = "http") {
  std::printf("listening on %s://127.0.0.1:%u\n", scheme, port);
  std::fflush(stdout);
}

inline std::string next_payload(const Arguments& arguments, std::uint64_t sequence) {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return write_payload({sequence, std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec}, arguments.bytes);
}

/// The answer to the key that the bench's clients always say.
inline constexpr std::string_view upgrade_response =
    "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    "Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n\r\n";

/// A whole binary message as a server frames it.
inline std::string server_frame(std::string_view payload) {
  std::string frame("\x82");
  if (payload.size() < 126) {
    frame.push_back(static_cast<char>(payload.size()));
  } else {
    const bool small = payload.size() < 65536;
    frame.push_back(small ? 126 : 127);
    for (unsigned i = small ? 2 : 8; i-- > 0;) frame.push_back(static_cast<char>(payload.size() >> (8U * i)));
  }
  return frame.append(payload);
}

}  // namespace semblante::bench::rivals
