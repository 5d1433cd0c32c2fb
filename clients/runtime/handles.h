#pragma once

#include "clients/runtime/player.h"
#include "clients/runtime/stream.h"

/// What the opaque handles of the C interface are.
struct semblante_stream {
  explicit semblante_stream(const semblante::runtime::StreamOptions& options) : it(options) {}
  semblante::runtime::Stream it;
  semblante::runtime::Event told;  ///< the newest event that was taken: the caller may read its packet
};

struct semblante_player {
  explicit semblante_player(const semblante::runtime::PlayerOptions& options) : it(options) {}
  semblante::runtime::Player it;
};
