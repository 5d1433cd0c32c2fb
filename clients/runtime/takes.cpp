#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "clients/runtime/border.h"
#include "clients/runtime/times.h"
#include "core/bridges/live_link_csv.h"
#include "core/types/decimal.h"
#include "protocol/cpp/fap_file_frames.h"
#include "protocol/cpp/kernel_values.h"

struct semblante_take {
  std::vector<semblante_timed_frame> frames;
  double rate = 0;
  std::vector<semblante_take_warning> warnings;
};

namespace semblante::runtime {
namespace {

constexpr double greatest_rate = 1000;
constexpr double least_rate = 0.001;

/// Frames per second by the mean distance of the frames; 25 for a single one.
double mean_rate(std::span<const semblante_timed_frame> frames) {
  const double span = frames.empty() ? 0 : frames.back().time - frames.front().time;
  return span > 0 ? 1000 * static_cast<double>(frames.size() - 1) / span : 25;
}

semblante_take_warning warning_of(std::uint32_t oddity, std::uint32_t line, std::uint32_t count,
                                  const std::string& text) {
  semblante_take_warning warning{};
  warning.oddity = oddity;
  warning.line = line;
  warning.count = count;
  copy_text(warning.message, text);
  return warning;
}

Status read_fap(std::string_view text, const FapFileMeaning& meaning, semblante_take& take) {
  const auto reading = read_fap_file(text);
  if (!reading) return reading.error();
  const auto frames = frames_of(reading->file, meaning);
  if (!frames) return frames.error();
  take.rate = reading->file.rate;
  take.frames.reserve(frames->size());
  for (const auto& [time, state] : *frames) take.frames.push_back({static_cast<double>(time), to_kernel_frame(state)});
  for (const FapFileWarning& warning : reading->warnings) {
    take.warnings.push_back(
        warning_of(static_cast<std::uint32_t>(warning.oddity), warning.line, warning.count, to_sentence(warning)));
  }
  return Unit{};
}

Status read_live_link(std::string_view text, semblante_take& take) {
  const auto read = read_live_link_csv(text);
  if (!read) return read.error();
  take.frames.reserve(read->rows.size());
  for (const LiveLinkRow& row : read->rows) {
    auto made = frame_from_arkit(row.coefficients);
    if (!made) return std::move(made).error();
    turn_head(made->frame, row.head);
    take.frames.push_back({1000 * row.seconds, made->frame});
  }
  take.rate = mean_rate(take.frames);
  for (const std::string& text_of_warning : read->warnings)
    take.warnings.push_back(warning_of(0, 0, 0, text_of_warning));
  return Unit{};
}

Result<std::string> write_fap(std::span<const semblante_timed_frame> frames, double rate) {
  std::vector<TimedValues> values;
  values.reserve(frames.size());
  for (const auto& [time, frame] : frames) {
    values.push_back({static_cast<std::uint32_t>(std::llround(time - frames.front().time)), to_values(frame)});
  }
  FapFileStyle style;
  style.rate = rate;
  const auto file = fap_file_of(values, style);
  if (!file) return file.error();
  return write_fap_file(*file);
}

Result<std::string> write_live_link(std::span<const semblante_timed_frame> frames, double rate) {
  std::vector<LiveLinkRow> rows;
  rows.reserve(frames.size());
  for (const auto& [time, frame] : frames) {
    rows.push_back(live_link_row_of((time - frames.front().time) / 1000, frame));
  }
  return write_live_link_csv(rows, rate > 0 ? rate : live_link_timecode_rate);
}

/// Why frames cannot be written; empty: they can.
std::string_view fault_of(std::span<const semblante_timed_frame> frames, double rate) {
  if (frames.empty()) return "there are no frames";
  if (!(rate == 0 || (rate >= least_rate && rate <= greatest_rate))) return "the rate must be 0, or 0.001 to 1000";
  double before = frames.front().time;
  for (const auto& [time, frame] : frames) {
    if (!is_time(time) || time < before) return "the times must be numbers that do not fall";
    if (time - frames.front().time > static_cast<double>(max_frame_time)) return "the frames are over a day long";
    if (!is_finite(frame)) return "a FAP is not a finite number";
    before = time;
  }
  return {};
}

}  // namespace
}  // namespace semblante::runtime

using namespace semblante;
using namespace semblante::runtime;

extern "C" {

semblante_result semblante_take_read(uint32_t format, const char* text, size_t size,
                                     const semblante_take_options* options, semblante_take** take,
                                     semblante_error* error) {
  if (take == nullptr) return fail(error, SEMBLANTE_INVALID_ARGUMENT, "take", "the pointer for it is null");
  *take = nullptr;
  if (text == nullptr) return fail(error, SEMBLANTE_INVALID_ARGUMENT, "text", "is null");
  if (format > SEMBLANTE_TAKE_LIVE_LINK_CSV) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "format", "there is no such format");
  }
  semblante_take_options given;
  if (!read_struct(options, given)) return fail(error, SEMBLANTE_INVALID_ARGUMENT, "options.size", "is too small");
  if (given.absent > 1 || given.gaps > 1) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, given.absent > 1 ? "options.absent" : "options.gaps",
                "must be 0 or 1");
  }
  const FapFileMeaning meaning = {static_cast<AbsentFap>(given.absent), static_cast<FrameGap>(given.gaps)};
  return guarded(error, [&] {
    auto made = std::make_unique<semblante_take>();
    const Status read =
        format == SEMBLANTE_TAKE_FAP ? read_fap({text, size}, meaning, *made) : read_live_link({text, size}, *made);
    if (!read) return fail(error, read.error());
    *take = made.release();
    return SEMBLANTE_OK;
  });
}

void semblante_take_destroy(semblante_take* take) { delete take; }

const semblante_timed_frame* semblante_take_frames(const semblante_take* take, uint32_t* count) {
  if (count != nullptr) *count = take == nullptr ? 0 : static_cast<uint32_t>(take->frames.size());
  return take == nullptr || take->frames.empty() ? nullptr : take->frames.data();
}

double semblante_take_frame_rate(const semblante_take* take) { return take == nullptr ? 0 : take->rate; }

uint32_t semblante_take_warning_count(const semblante_take* take) {
  return take == nullptr ? 0 : static_cast<uint32_t>(take->warnings.size());
}

semblante_result semblante_take_get_warning(const semblante_take* take, uint32_t index,
                                            semblante_take_warning* warning) {
  if (take == nullptr || index >= take->warnings.size()) return SEMBLANTE_INVALID_ARGUMENT;
  return write_struct(take->warnings[index], warning) ? SEMBLANTE_OK : SEMBLANTE_INVALID_ARGUMENT;
}

semblante_result semblante_take_write(uint32_t format, const semblante_timed_frame* frames, uint32_t count, double rate,
                                      char* text, size_t* size, semblante_error* error) {
  if (frames == nullptr || size == nullptr) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, frames == nullptr ? "frames" : "size", "is null");
  }
  if (format > SEMBLANTE_TAKE_LIVE_LINK_CSV) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "format", "there is no such format");
  }
  if (const std::string_view fault = fault_of({frames, count}, rate); !fault.empty()) {
    return fail(error, SEMBLANTE_INVALID_ARGUMENT, "frames", fault);
  }
  return guarded(error, [&] {
    const auto written =
        format == SEMBLANTE_TAKE_FAP ? write_fap({frames, count}, rate) : write_live_link({frames, count}, rate);
    if (!written) return fail(error, written.error());
    const size_t capacity = text == nullptr ? 0 : *size;
    *size = written->size();
    if (written->size() > capacity) {
      return fail(error, SEMBLANTE_BUFFER_TOO_SMALL, "size", "the file needs " + natural_text(*size) + " bytes");
    }
    std::copy(written->begin(), written->end(), text);
    return SEMBLANTE_OK;
  });
}

}  // extern "C"
