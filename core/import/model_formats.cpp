#include "core/import/model_formats.h"

#include "core/types/letter_case.h"

namespace semblante {
namespace {

bool has_ending(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() && equal_ignoring_case(name.substr(name.size() - ending.size()), ending);
}

}  // namespace

std::string_view to_string(ModelFormat format) {
  for (const auto& row : model_formats) {
    if (row.format == format) return row.name;
  }
  return "";
}

std::optional<ModelFormat> parse_model_format(std::string_view name) {
  for (const auto& row : model_formats) {
    if (row.name == name) return row.format;
  }
  return std::nullopt;
}

std::optional<ModelFormat> format_of_name(std::string_view file_name) {
  for (const ModelFile& file : model_files) {
    if (has_ending(file_name, file.ending)) return file.format;
  }
  return std::nullopt;
}

std::string model_file_titles() {
  std::string titles;
  for (const ModelFile& file : model_files) titles.append(titles.empty() ? "" : ", ").append(file.title);
  return titles;
}

}  // namespace semblante
