#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "server/settings/stream_settings.h"
#include "server/streams/encoding.h"
#include "server/streams/frame_source.h"
#include "server/streams/source.h"
#include "server/streams/stream_counts.h"

namespace semblante::streams {

/// The play that is running in a stream. Times in ms.
struct PlayStatus {
  std::string id, kind, name;
  double duration = 0.0;  ///< 0: endless; while it is being made: of what there is
  double position = 0.0;
  double rate = 0.0;  ///< frames per second
  bool loop = false;
  Making making = {};
};

/// The status of a stream. A stream is made from the first four members.
struct StreamInfo {
  std::string id, created;
  std::string source;  ///< "demo" or "none": feeds the stream when no other source does
  settings::StreamSettings settings;
  std::uint64_t epoch = 0;     ///< of this instance of the stream; assigned by the hub
  std::uint64_t sequence = 0;  ///< of the newest frame taken
  std::size_t subscribers = 0, publishers = 0;
  std::optional<PlayStatus> playing;      ///< filled in by the hub
  std::optional<PlayStatus> failed{};     ///< the last play, if it ended early; filled in by the hub
  std::uint64_t clamped_values = 0;       ///< values outside the range of their FAP
  std::optional<Source> active_source{};  ///< feeds it now; requests: within the last seconds
  std::array<std::size_t, coding_count> subscribers_by_coding{};
  StreamCounts counts{};
};

/// The result of publishing the frames of a request.
struct PublishReceipt {
  std::size_t accepted = 0;
  std::uint64_t sequence = 0;  ///< of the last frame
  std::size_t clamped = 0;     ///< values outside the range of their FAP
};

}  // namespace semblante::streams
