#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "core/json/json_cursor.h"
#include "core/json/json_tree.h"
#include "core/speech/timelines/timeline_builder.h"
#include "core/speech/timelines/timeline_lines.h"

namespace semblante {

inline constexpr std::size_t most_text_bytes = 2000;
inline constexpr JsonLimits timeline_json_limits = {
    .max_bytes = max_timeline_bytes, .max_depth = 8, .max_values = 8 * max_timeline_events};

/// Reads a document that is one object.
template <class Take>
void read_object(std::string_view file, TimelineBuilder& builder, Take take) {
  const auto tree = read_json_object_tree(file, timeline_json_limits);
  if (!tree) return builder.fail(tree.error().code, tree.error().where, "cannot be read: " + tree.error().message);
  JsonCursor::Report report;
  take(JsonCursor(*tree, report));
  if (report) builder.fail(report->code, report->where, report->message);
}

/// A document, or objects a line; each with its place.
template <class Take>
void each_value(std::string_view file, TimelineBuilder& builder, Take take) {
  const auto read = [&](std::string_view text, const std::string& where, bool whole) {
    const auto tree = read_json_tree(text, timeline_json_limits);
    if (!tree)
      return builder.fail(tree.error().code, where + tree.error().where, "cannot be read: " + tree.error().message);
    JsonCursor::Report report;
    const JsonCursor root(tree->root(), where, report);
    if (!whole) {
      take(root);
    } else {
      for (const JsonCursor& element : root.elements(1, max_timeline_events)) {
        take(element);
        if (report || builder.failed()) break;
      }
    }
    if (report) builder.fail(report->code, report->where, report->message);
  };
  if (file.find_first_not_of(" \t\r\n") != std::string_view::npos && file[file.find_first_not_of(" \t\r\n")] == '[')
    return read(file, "", true);
  each_line(file, builder, [&](std::string_view line, const std::string& where) { read(line, where, false); });
}

/// The member by one of its names: as it is documented, or as a language's binding writes it.
inline std::optional<JsonCursor> member_of(const JsonCursor& object, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (auto found = object.optional_member(name)) return found;
  return std::nullopt;
}

}  // namespace semblante
