#include "tests/bench/fanout/content.h"

#include <algorithm>
#include <span>
#include <string>

#include "protocol/cpp/json_codec.h"
#include "tests/bench/fanout/batch_grid.h"
#include "tests/bench/fanout/rivals/payload.h"
#include "tests/bench/fanout/trace.h"

namespace semblante::bench {
namespace {

/// Either form of the protocol; the binary one has a state.
class MessageReader {
 public:
  explicit MessageReader(Coding coding) : json_(coding == Coding::json) {}
  Result<Message> read(std::string_view bytes) {
    if (json_) return decode_json(bytes);
    return decoder_.decode(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
  }

 private:
  bool json_;
  FrameDecoder decoder_;
};

class StreamSample : public Content::Sample {
 public:
  explicit StreamSample(Coding coding) : reader_(coding) {}
  bool agrees(std::string_view bytes, const Batch* batch) override {
    const auto message = reader_.read(bytes);
    if (!message) return false;
    if (batch == nullptr) return true;
    const auto* frames = std::get_if<Frames>(&*message);
    return frames != nullptr && *frames == batch->frames;
  }

 private:
  MessageReader reader_;
};

class StreamContent : public Content {
 public:
  StreamContent(Coding coding, const SendTimes& sent, bool heavy)
      : coding_(coding), sent_(sent), heavy_(heavy), hello_(hello_frame(coding)), reader_(coding) {}

  std::optional<Batch> next(std::string_view bytes, std::int64_t now) override {
    if (!begun_) return std::nullopt;
    MessageReader before = reader_;
    auto message = reader_.read(bytes);
    auto* frames = message ? std::get_if<Frames>(&*message) : nullptr;
    if (frames == nullptr || frames->frames.empty() || frames->sequence != last_ + 1) {
      reader_ = before;
      return std::nullopt;
    }
    Batch batch;
    batch.first = frames->sequence;
    batch.last = last_ = batch.first + frames->frames.size() - 1;
    batch.due = grid_.due(sent_.get(batch.first), sent_.get(batch.last), now);
    for (std::size_t i = 0; i < frames->frames.size(); ++i)
      if (frames->frames[i].state != trace_frame(batch.first + i, heavy_)) ++wrong_states_;
    batch.frames = std::move(*frames);
    return batch;
  }

  Notice notice(std::string_view bytes) override {
    MessageReader reader(coding_);
    const auto message = reader.read(bytes);
    if (!message) return {};
    if (const auto* header = std::get_if<Header>(&*message)) {
      grid_.set_interval(std::int64_t{header->batch_interval} * 1'000'000);
      return {Notice::Kind::header, 0};
    }
    if (std::holds_alternative<StreamError>(*message)) return {Notice::Kind::error, 0};
    if (std::holds_alternative<End>(*message)) return {Notice::Kind::end, 0};
    const auto* key = std::get_if<Keyframe>(&*message);
    if (key == nullptr) return {Notice::Kind::other, 0};
    if (!begun_) {
      begun_ = true;
      last_ = key->sequence;
      reader_ = reader;
    }
    return {Notice::Kind::join, key->sequence};
  }

  [[nodiscard]] std::uint64_t next_frame() const override { return begun_ ? last_ + 1 : 0; }
  [[nodiscard]] const std::string& hello() const override { return hello_; }
  [[nodiscard]] std::string_view subprotocol() const override { return subprotocol_of(coding_); }
  void begin_measuring() override { grid_.restart(); }
  [[nodiscard]] std::uint64_t wrong_states() const override { return wrong_states_; }
  [[nodiscard]] std::unique_ptr<Sample> sample() const override { return std::make_unique<StreamSample>(coding_); }

 private:
  const Coding coding_;
  const SendTimes& sent_;
  const bool heavy_;
  const std::string hello_;
  BatchGrid grid_;
  MessageReader reader_;
  bool begun_ = false;
  std::uint64_t last_ = 0, wrong_states_ = 0;
};

class RivalContent : public Content {
 public:
  std::optional<Batch> next(std::string_view bytes, std::int64_t) override {
    const auto payload = rivals::read_payload(bytes);
    if (!payload || (last_ != 0 && payload->sequence != last_ + 1)) return std::nullopt;
    last_ = payload->sequence;
    return Batch{last_, last_, payload->sent_ns, {}};
  }
  Notice notice(std::string_view bytes) override {
    const auto payload = rivals::read_payload(bytes);
    return payload ? Notice{Notice::Kind::join, payload->sequence - 1} : Notice{};
  }
  [[nodiscard]] std::uint64_t next_frame() const override { return last_ == 0 ? 0 : last_ + 1; }
  [[nodiscard]] const std::string& hello() const override { return hello_; }
  [[nodiscard]] std::string_view subprotocol() const override { return {}; }

 private:
  const std::string hello_;
  std::uint64_t last_ = 0;
};

}  // namespace

std::unique_ptr<Content> stream_content(Coding coding, const SendTimes& sent, bool heavy) {
  return std::make_unique<StreamContent>(coding, sent, heavy);
}

std::unique_ptr<Content> rival_content() { return std::make_unique<RivalContent>(); }

}  // namespace semblante::bench
