#include "tests/bench/coding/training.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "protocol/cpp/packed_model.h"

namespace semblante::bench {
namespace {

struct Count {
  double zeros = 0, ones = 0;
};
using Counts = std::array<Count, packed_tables::size>;

/// Writes nothing; counts what each context is asked to say.
class CountingCoder {
 public:
  static constexpr bool decodes = false;

  CountingCoder(const PackedTable& table, Counts& counts, double weight)
      : table_(table), counts_(counts), weight_(weight) {}

  int bit(const std::uint16_t& probability, int value) {
    Count& count = counts_[static_cast<std::size_t>(&probability - table_.data())];
    (value != 0 ? count.ones : count.zeros) += weight_;
    return value;
  }
  static std::uint64_t bits(unsigned /*count*/, std::uint64_t value) { return value; }

 private:
  const PackedTable& table_;
  Counts& counts_;
  double weight_;
};

void count(const Trace& trace, std::size_t per_message, double weight, Counts& counts) {
  const PackedTable& table = packed_tables::values;
  CountingCoder coder(table, counts, weight);
  PackedState state;
  PackedModel model(coder, table, state);
  PackedState start;
  const Keyframe keyframe = first_frame(trace);
  start.before.fill(keyframe.state);
  model.history(start);
  state.media_time = keyframe.media_time;
  std::size_t number = 0;
  for (const Frames& batch : batches(trace, per_message)) {
    model.count(batch.frames.size());
    model.base_time(batch.media_time);
    model.offset(batch.frames.front().time);
    for (std::size_t i = 0; i < batch.frames.size(); ++i) {
      if (i > 0) model.step(batch.frames[i].time - batch.frames[i - 1].time);
      FaceFrame now = batch.frames[i].state;
      model.frame(now);
    }
    // Who joins now and then.
    if (++number % 50 != 0) continue;
    PackedState said;
    PackedModel join(coder, table, said);
    state.fresh = false;
    join.history(state);
  }
}

}  // namespace

Keyframe first_frame(const Trace& trace) { return {1, trace.frames.front().time, trace.frames.front().state}; }

std::vector<Frames> batches(const Trace& trace, std::size_t per_message) {
  std::vector<Frames> messages;
  for (std::size_t i = 1; i < trace.frames.size(); i += per_message) {
    Frames message{i + 1, trace.frames[i].time, {}};
    for (std::size_t k = i; k < std::min(i + per_message, trace.frames.size()); ++k) {
      message.frames.push_back({trace.frames[k].time - trace.frames[i].time, trace.frames[k].state});
    }
    messages.push_back(std::move(message));
  }
  return messages;
}

PackedTable trained(std::span<const Trace> traces) {
  Counts counts{};
  for (const Trace& trace : traces) {
    for (const std::size_t per_message : {1U, 3U, 5U}) count(trace, per_message, trace.weight / 3, counts);
  }
  PackedTable table{};
  std::transform(counts.begin(), counts.end(), table.begin(), [](const Count& count) {
    // Half an occurrence of each, so that what was never seen costs little; and never surer than 1 in 340, since other
    // faces do other things.
    const double probability = (count.ones + 0.5) / (count.ones + count.zeros + 1);
    return static_cast<std::uint16_t>(std::clamp(std::lround(4096 * probability), 12L, 4096L - 12L));
  });
  return table;
}

}  // namespace semblante::bench
