#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/bridges/arkit.h"
#include "core/bridges/head_turn.h"
#include "core/types/result.h"

namespace semblante {

/// One row of a take: ARKit's parameters of a face at one time.
struct LiveLinkRow {
  double seconds = 0.0;  ///< since the first row; never decreases
  ArkitCoefficients coefficients{};
  HeadTurn head;
  EyeTurn left_eye, right_eye;
};

struct LiveLinkTake {
  std::vector<LiveLinkRow> rows;      ///< at least one
  std::vector<std::string> warnings;  ///< skipped and missing columns, as text
};

/// Frames per second of the app's timecodes; a take of 30 frames per second steps by two.
inline constexpr double live_link_timecode_rate = 60.0;
inline constexpr std::size_t max_live_link_bytes = std::size_t{64} << 20U;
inline constexpr std::size_t max_live_link_rows = 500'000;
inline constexpr std::size_t max_live_link_columns = 256;

/// Reads the CSV file of Live Link Face: `Timecode,BlendShapeCount,` and one column per shape. Columns are found by
/// name, because the file's order (JawRight before JawLeft) differs from the stream's. Timecodes are HH:MM:SS:FF.sub. A
/// row with a BlendShapeCount of 0 has no face and repeats the previous row. Errors name the line ("line 12").
Result<LiveLinkTake> read_live_link_csv(std::string_view text, double timecode_rate = live_link_timecode_rate);

/// Converts a face to the row that the app would write.
LiveLinkRow live_link_row_of(double seconds, const semblante_frame& face);

/// Header and rows of the file, for incremental writing.
void append_live_link_header(std::string& to);
void append_live_link_row(std::string& to, const LiveLinkRow& row, double timecode_rate = live_link_timecode_rate);

/// Writes the file: all 61 columns in the app's order, timecodes from 00:00:00:00.000, lines end with LF.
std::string write_live_link_csv(std::span<const LiveLinkRow> rows, double timecode_rate = live_link_timecode_rate);

}  // namespace semblante
