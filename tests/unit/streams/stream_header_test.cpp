#include "server/streams/stream_header.h"

#include <gtest/gtest.h>

#include "protocol/cpp/frame_codec.h"
#include "protocol/cpp/quantizers.h"
#include "tests/support/frame_encoder.h"

namespace semblante::streams {
namespace {

/// What a client reads of the header of a stream with these steps, and its size on the wire.
std::pair<Header, std::size_t> as_read(double quantizer_scale) {
  StreamInfo stream;
  stream.id = "demo";
  stream.epoch = 1;
  stream.settings.quantizer_scale = quantizer_scale;
  const auto bytes = FrameEncoder().encode(connection_header(stream, 41, 1640, 25.0, false, false));
  const auto message = FrameDecoder().decode(bytes);
  EXPECT_TRUE(message.ok());
  return {std::get<Header>(*message), bytes.size()};
}

TEST(StreamHeader, StandardSteps_AreNotSent) {
  const auto [header, size] = as_read(1.0);
  EXPECT_TRUE(header.quantizers.empty());
  EXPECT_EQ(quantizers_of(header), standard_quantizers());
  EXPECT_LT(size, 66 * sizeof(double)) << "shorter than a list of steps alone";
}

TEST(StreamHeader, FinerSteps_AreSentInFull) {
  const auto [standard, standard_size] = as_read(1.0);
  for (const double scale : {0.5, 0.25, 0.125}) {
    const auto [header, size] = as_read(scale);
    EXPECT_EQ(header.quantizers.size(), 66U);
    EXPECT_EQ(quantizers_of(header), scaled_quantizers(scale));
    EXPECT_EQ(size, standard_size + 66 * sizeof(double));
  }
}

}  // namespace
}  // namespace semblante::streams
