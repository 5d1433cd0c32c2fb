#include "server/streams/stream_header.h"

#include <algorithm>
#include <cmath>

#include "protocol/cpp/quantizers.h"
#include "server/streams/timeline.h"

namespace semblante::streams {

Header stream_header(const StreamInfo& stream, std::uint64_t sequence) {
  Header header;
  header.stream = stream.id;
  header.title = stream.settings.title;
  header.model = stream.settings.model;
  header.epoch = stream.epoch;
  header.sequence = sequence;
  header.server_time = server_time_now();
  header.quantizers = header_quantizers(stream.settings.quantizer_scale);
  header.viseme_share = stream.settings.viseme_share;
  return header;
}

Header connection_header(const StreamInfo& stream, std::uint64_t sequence, std::uint64_t media_time, double rate,
                         bool recovered, bool sound) {
  Header header = stream_header(stream, sequence);
  header.media_time = media_time;
  header.batch_interval = stream.settings.batch_interval;
  if (rate > 0.0) {
    header.fps_hint = rate;
    header.batch_interval = std::max(header.batch_interval, static_cast<std::uint32_t>(std::lround(1000.0 / rate)));
  }
  header.recovered = recovered;
  if (sound) header.sound = stream_sound;
  return header;
}

}  // namespace semblante::streams
