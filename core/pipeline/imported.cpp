#include "core/pipeline/imported.h"

#include <utility>

#include "core/pipeline/outward.h"

namespace semblante {

Result<ImportedHead> import_head(std::span<const std::uint8_t> bytes, const ImportRequest& request,
                                 const Progress& progress) {
  if (auto told = report_progress(progress, 0.0, "reading"); !told) return told.error();
  const auto format = request.format ? Result(*request.format) : format_of(bytes, request.file_name);
  if (!format) return format.error();
  auto model = import_model(bytes, *format, request.limits, request.resources);
  if (!model) return model.error();
  ImportedHead head;
  head.model = std::move(*model);
  head.warnings.file = std::move(head.model.warnings);
  head.model.warnings.clear();
  if (turn_outward(head.model))
    head.warnings.file.emplace_back(
        "the model was inside out, as one that was mirrored: its triangles faced inwards; all are turned over");
  return head;
}

}  // namespace semblante
