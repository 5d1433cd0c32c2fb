#include "server/recordings/recording_export.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <utility>

#include "core/bridges/live_link_csv.h"
#include "core/performance/performance.h"
#include "core/performance/record.h"
#include "protocol/cpp/fap_file_frames.h"
#include "protocol/cpp/json_codec.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/performance_document.h"
#include "server/recordings/ogg_opus.h"

namespace semblante::recordings {
namespace {

using SharedReader = std::shared_ptr<const RecordingReader>;

Error unwritable() { return {ErrorCode::io, "", "it cannot be written"}; }
Error too_long() {
  return {ErrorCode::too_large, "", "it is over " + std::to_string(max_written_bytes) + " bytes: take a part"};
}
Error nothing() { return {ErrorCode::empty, "", "there is no frame in this part of the recording"}; }

/// The smallest ratio of a stream's quantizer step to the standard one.
double fineness(const QuantizerSteps& steps) {
  double least = 1.0;
  for (std::size_t fap = first_low_level_fap; fap <= last_low_level_fap; ++fap)
    least = std::min(least, steps[fap] / standard_quantizers()[fap]);
  return least;
}

/// Passes every face of a cut to `write`, which returns the number of bytes written to `to`.
template <class Write>
Status write_each(SharedReader reader, const Cut& cut, const std::ostream& to, Write write) {
  CutFrames frames(std::move(reader), cut);
  TimedValues frame;
  std::uint64_t bytes = 0;
  while (frames.next(frame)) {
    bytes += write(frame);
    if (!to) return unwritable();
    if (bytes > max_written_bytes) return too_long();
  }
  if (frames.error()) return *frames.error();
  if (bytes == 0) return nothing();
  return Unit{};
}

}  // namespace

CutFrames::CutFrames(SharedReader reader, const Cut& cut)
    : reader_(std::move(reader)), cut_(cut), steps_(quantizers_of(reader_->header())), cursor_(reader_, cut.from) {}

bool CutFrames::next_frame(TimedValues& frame) {
  if (!std::exchange(led_in_, true)) {
    const bool before = cut_.from > 0 && cut_.from <= cut_.to && cut_.from <= reader_->duration() &&
                        (cursor_.frame() == nullptr || cursor_.time() > cut_.from);
    if (before) {
      const auto held = reader_->at(cut_.from);
      if (!held) error_ = held.error();
      if (!held || !*held) return false;
      frame = {0, to_values((*held)->state, steps_)};
      return true;
    }
  }
  if (cursor_.error()) error_ = cursor_.error();
  if (cursor_.frame() == nullptr || cursor_.time() > cut_.to) return false;
  frame = {cursor_.time() - cut_.from, to_values(cursor_.frame()->state, steps_)};
  cursor_.advance();
  return true;
}

bool CutFrames::next(TimedValues& frame) {
  if (cut_.rate <= 0.0) return next_frame(frame);
  const auto step = [this] {
    before_ = std::exchange(after_, std::nullopt);
    TimedValues next;
    if (next_frame(next)) after_ = next;
  };
  if (!before_ && !after_) step();
  if (!before_ && after_) step();
  if (!before_) return false;
  const double at = static_cast<double>(sample_) * 1000.0 / cut_.rate;
  while (after_ && after_->time <= at) step();
  if (!after_ && at > before_->time && sample_ > 0) return false;
  ++sample_;
  const double span = after_ ? after_->time - before_->time : 1.0;
  const double t = after_ ? std::max(0.0, at - before_->time) / span : 0.0;
  frame = {static_cast<std::uint32_t>(std::lround(at)),
           t > 0.0 ? between(before_->state, after_->state, t) : before_->state};
  return !error_;
}

Result<std::vector<TimedValues>> gather(SharedReader reader, const Cut& cut, std::size_t most) {
  CutFrames source(std::move(reader), cut);
  std::vector<TimedValues> frames;
  TimedValues frame;
  while (source.next(frame)) {
    if (frames.size() == most)
      return Error{ErrorCode::too_large, "", "it has more than " + std::to_string(most) + " frames: take a part"};
    frames.push_back(frame);
  }
  if (source.error()) return *source.error();
  if (frames.empty()) return nothing();
  return frames;
}

Result<std::string> export_performance(SharedReader reader, const Cut& cut, const std::string& name) {
  constexpr double exact_after_rounding = 0.25;
  const double tolerance = exact_after_rounding * fineness(quantizers_of(reader->header()));
  std::vector<RecordedFrame> faces;
  CutFrames source(std::move(reader), cut);
  TimedValues frame;
  while (source.next(frame)) {
    if (faces.size() == max_gathered_frames)
      return Error{ErrorCode::too_large, "",
                   "it has more than " + std::to_string(max_gathered_frames) + " frames: take a part"};
    faces.push_back({static_cast<double>(frame.time), to_kernel_frame(frame.state)});
  }
  if (source.error()) return *source.error();
  if (faces.empty()) return nothing();
  auto script = record_performance(faces, {tolerance});
  if (!script) return script.error();
  script->name = name;
  if (const auto performance = Performance::compile(*script); !performance) return performance.error();
  auto text = write_performance(*script);
  if (text.size() > max_performance_bytes)
    return Error{ErrorCode::too_large, "",
                 "the document is over the " + std::to_string(max_performance_bytes) + " bytes of one: take a part"};
  return text;
}

Result<std::string> export_fap(SharedReader reader, const Cut& cut, const std::string& name) {
  // The .fap format resamples the frames itself, so that both ways to request a rate give the same file.
  auto frames = gather(std::move(reader), {cut.from, cut.to, 0.0});
  if (!frames) return frames.error();
  FapFileStyle style;
  style.rate = cut.rate;
  style.name = name;
  const auto file = fap_file_of(*frames, style);
  if (!file) return file.error();
  return write_fap_file(*file);
}

Status export_frames(SharedReader reader, const Cut& cut, std::ostream& to) {
  bool first = true;
  to << "{\"frames\": [";
  auto status = write_each(std::move(reader), cut, to, [&](const TimedValues& frame) {
    const auto line = encode_json_value(frame);
    to << (std::exchange(first, false) ? "\n" : ",\n") << line;
    return line.size() + 2;
  });
  to << "\n]}\n";
  return status;
}

Status export_arkit_csv(SharedReader reader, const Cut& cut, std::ostream& to) {
  std::string text;
  append_live_link_header(text);
  to << text;
  return write_each(std::move(reader), cut, to, [&](const TimedValues& frame) {
    text.clear();
    append_live_link_row(text, live_link_row_of(frame.time / 1000.0, to_kernel_frame(frame.state)));
    to << text;
    return text.size();
  });
}

Status export_sound(const SharedReader& reader, const Cut& cut, std::ostream& to) {
  RecordingSoundCursor cursor(reader, cut.from);
  const auto in_cut = [&] { return cursor.packet() != nullptr && cursor.packet()->media_time <= cut.to; };
  if (!in_cut() && !cursor.error()) return Error{ErrorCode::empty, "", "there is no sound in it"};
  const auto& track = reader->header().sound;
  OggOpusWriter writer(to, track && track->channels == 2 ? 2 : 1);
  for (; in_cut(); cursor.advance()) {
    writer.add(cursor.packet()->media_time - cut.from, cursor.packet()->packet);
    if (!to) return unwritable();
    if (writer.bytes() > max_written_bytes) return too_long();
  }
  if (cursor.error()) return *cursor.error();
  writer.finish();
  return to ? Status(Unit{}) : unwritable();
}

}  // namespace semblante::recordings
