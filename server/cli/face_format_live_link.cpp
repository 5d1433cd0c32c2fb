#include <cmath>

#include "core/bridges/live_link_csv.h"
#include "protocol/cpp/kernel_values.h"
#include "protocol/cpp/messages.h"
#include "server/cli/face_formats.h"

namespace semblante {

Result<FaceSequence> read_live_link_faces(std::string_view text, const FaceReading& /*reading*/) {
  const auto take = read_live_link_csv(text);
  if (!take) return take.error();
  FaceSequence sequence{{}, 0, take->warnings};
  std::size_t clamped = 0;
  for (const LiveLinkRow& row : take->rows) {
    auto made = frame_from_arkit(row.coefficients);
    if (!made) return made.error();
    clamped += made->clamped;
    turn_head(made->frame, row.head);
    const double milliseconds = std::round(row.seconds * 1000.0);
    if (milliseconds > static_cast<double>(max_frame_time)) {
      return Error{ErrorCode::too_large, "", "longer than " + std::to_string(max_frame_time / 1000) + " s"};
    }
    sequence.frames.push_back({static_cast<std::uint32_t>(milliseconds), to_values(made->frame)});
  }
  if (clamped > 0) {
    sequence.warnings.push_back(std::to_string(clamped) + " coefficients outside 0 to 1 were taken as 0 or 1");
  }
  return sequence;
}

Result<std::string> write_live_link_faces(const FaceSequence& sequence, const FaceWriting& /*writing*/) {
  std::vector<LiveLinkRow> rows;
  for (const TimedValues& timed : sequence.frames)
    rows.push_back(live_link_row_of(timed.time / 1000.0, to_kernel_frame(timed.state)));
  return write_live_link_csv(rows);
}

}  // namespace semblante
