#include <string>

#include "core/types/decimal.h"
#include "protocol/cpp/byte_io.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/packed_model.h"
#include "protocol/cpp/range_coder.h"

namespace semblante {
namespace {

/// `where()`: the pointer, made only for an error.
template <class Coder, class Where>
Status check(const RangeDecoder& coder, const PackedModel<Coder>& model, const Where& where) {
  if (!coder.valid()) return Error{ErrorCode::malformed, where(), "is not the start of a packed message"};
  if (coder.truncated()) return Error{ErrorCode::truncated, where(), "the message ends within a packed state"};
  if (!model.fault().empty()) return Error{ErrorCode::out_of_range, where() + model.fault(), "outside its range"};
  return Unit{};
}

/// Refuses bytes after the code: it has no end marker, so later versions cannot append fields and use new types.
Status check_end(const RangeDecoder& coder, const char* where) {
  if (coder.has_more()) return Error{ErrorCode::malformed, where, "bytes after the end"};
  return Unit{};
}

Error out_of_range(const char* where) { return {ErrorCode::out_of_range, where, "must be at most 2^53 - 1"}; }

}  // namespace

Result<Keyframe> read_packed_keyframe(std::span<const std::uint8_t> bytes, PackedState& state,
                                      const PackedTable& table) {
  byte_io::Reader reader(bytes);
  reader.u8();
  PackedState read;
  read.sequence = reader.varint();
  if (reader.failed()) return Error{ErrorCode::truncated, "/sequence", "the message ends within this field"};
  if (read.sequence > max_media_time) return out_of_range("/sequence");
  const std::uint64_t media_time = reader.varint();
  if (reader.failed()) return Error{ErrorCode::truncated, "/media_time", "the message ends within this field"};
  if (media_time > max_media_time) return out_of_range("/media_time");

  RangeDecoder coder(bytes.subspan(reader.position()));
  ModelCoder<RangeDecoder> model_coder(coder);
  PackedModel model(model_coder, table, read);
  model.history(PackedState{});
  read.media_time = media_time;
  if (auto status = check(coder, model, [] { return std::string("/state"); }); !status)
    return std::move(status).error();
  if (auto status = check_end(coder, "/state"); !status) return std::move(status).error();
  state = read;
  return Keyframe{read.sequence, media_time, read.before[0]};
}

Status read_packed_frames(std::span<const std::uint8_t> bytes, PackedState& state, Frames& frames,
                          const PackedTable& table) {
  const std::uint64_t next = state.sequence + 1;
  if (bytes.empty() || (bytes[0] & 0x7FU) != (next & 0x7FU)) {
    return Error{ErrorCode::mismatch, "/sequence", "frame " + natural_text(next) + " is expected"};
  }
  PackedState read = state;
  RangeDecoder coder(bytes.subspan(1));
  ModelCoder<RangeDecoder> model_coder(coder);
  PackedModel model(model_coder, table, read);
  frames.frames.clear();
  frames.sequence = next;
  const std::uint64_t count = model.count(0);
  frames.media_time = model.base_time(0);
  std::uint64_t time = model.offset(0);
  if (auto status = check(coder, model, [] { return std::string(); }); !status) return std::move(status).error();
  if (count > max_media_time - state.sequence) return out_of_range("/sequence");
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto where = [i] { return "/frames/" + natural_text(i); };
    TimedFrame frame;
    if (i > 0) time += model.step(0);
    if (time > max_frame_time) {
      return Error{ErrorCode::out_of_range, where() + "/time", "more than a day after media_time"};
    }
    frame.time = static_cast<std::uint32_t>(time);
    model.frame(frame.state);
    if (auto status = check(coder, model, where); !status) return std::move(status).error();
    frames.frames.push_back(frame);
  }
  if (auto status = check_end(coder, "/frames"); !status) return status;
  read.sequence += count;
  read.fresh = false;
  state = read;
  return Unit{};
}

}  // namespace semblante
