#include "core/pipeline/points_file.h"

#include <utility>

namespace semblante {

Result<MarkedHead> mark_by_file(ImportedHead head, FeaturePointsFile file, const FrameWish& wish,
                                bool leaves_out_refused, const Progress& progress) {
  if (file.to_mpeg4_axes && wish.has_axes()) {
    return Error{ErrorCode::invalid_argument, "/to_mpeg4_axes",
                 "sets the axes of the model, so up and front cannot be set as well"};
  }
  auto standing = stand_head(std::move(head), {wish, {}, file.to_mpeg4_axes}, progress);
  if (!standing) return standing.error();
  turn_points(file.points, standing->to_mpeg4);
  return mark_head(std::move(*standing), {std::move(file.points), {}, leaves_out_refused, file.fapu_by_user},
                   part_of(progress, 0.5, 1.0));
}

}  // namespace semblante
