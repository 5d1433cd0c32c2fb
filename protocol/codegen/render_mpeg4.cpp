// The tables of SPEC.md that come from core/tables.
#include <initializer_list>
#include <sstream>
#include <string>

#include "core/tables/mpeg4.h"
#include "protocol/codegen/render.h"

namespace semblante::codegen {
namespace {

std::string row(std::initializer_list<std::string> cells) {
  std::string out = "|";
  for (const std::string& cell : cells) out.append(" ").append(cell).append(" |");
  return out.append("\n");
}

std::string header(std::initializer_list<std::string> names) {
  std::string out = row(names).append("|");
  for (std::size_t i = 0; i < names.size(); ++i) out.append("---|");
  return out.append("\n");
}

std::string number(std::size_t value) { return std::to_string(value); }
std::string range(std::int64_t first, std::int64_t last) {
  return std::to_string(first).append(" to ").append(std::to_string(last));
}
std::string code(std::string_view name) { return std::string("`").append(name).append("`"); }
std::string point_id(std::size_t index) { return std::string(mpeg4::feature_points[index].id); }
char axis_name(int axis) { return std::string_view("xyz").at(static_cast<std::size_t>(axis)); }
void add(std::string& list, const std::string& item, const char* separator = ", ") {
  if (!list.empty()) list += separator;
  list += item;
}

std::string points_of(const mpeg4::Fap& fap) {
  std::string out;
  for (std::size_t i = 0; i < fap.feature_point_count; ++i) add(out, point_id(fap.feature_points[i]));
  return out;
}

/// What a positive value does: "+y" along an axis, "turn +y" about one.
std::string motion_of(const mpeg4::Fap& fap) {
  if (fap.kind == mpeg4::FapKind::high_level) return "set";
  if (fap.kind == mpeg4::FapKind::scale) return "pupil";
  if (fap.axis == mpeg4::no_axis) return "roll";
  std::string out = fap.kind == mpeg4::FapKind::rotation ? "turn " : "";
  out += fap.sign > 0 ? '+' : '-';
  return out += axis_name(fap.axis);
}

std::string measures_of(const mpeg4::FapuInfo& fapu) {
  std::string out;
  for (std::size_t i = 0; i < fapu.measure_count; ++i) {
    const mpeg4::Measure& measure = fapu.measures[i];
    std::string difference(1, axis_name(measure.axis));
    add(out, difference.append(" of ").append(point_id(measure.to)).append(" - ").append(point_id(measure.from)), "; ");
  }
  return out;
}

std::string faps_that_move(std::size_t point) {
  std::string out;
  for (const mpeg4::Fap& fap : mpeg4::faps) {
    for (std::size_t i = 0; i < fap.feature_point_count; ++i) {
      if (fap.feature_points[i] == point) add(out, number(fap.number));
    }
  }
  return out;
}

/// The number before the dot.
std::string_view group_of(std::string_view point) { return point.substr(0, point.find('.')); }

}  // namespace

std::string fap_table() {
  std::string out = header(
      {"FAP", "name", "group", "FP", "motion", "unit", "directions", "step", "range", "what a positive value does"});
  for (const mpeg4::Fap& fap : mpeg4::faps) {
    const std::string what(mpeg4::fap_descriptions[fap.number - 1]);
    const std::string unit(mpeg4::unit_names[static_cast<std::size_t>(fap.unit)]);
    if (fap.kind == mpeg4::FapKind::high_level) {
      out += row({number(fap.number), code(fap.name), number(fap.group), "", motion_of(fap), "", "", "", "", what});
    } else {
      out += row({number(fap.number), code(fap.name), number(fap.group), points_of(fap), motion_of(fap), unit,
                  fap.bidirectional ? "two" : "one", std::to_string(fap.quantizer_step), range(fap.min(), fap.max()),
                  what});
    }
  }
  return out;
}

std::string fap_group_table() {
  std::string out = header({"group", "FAPs", "what they move"});
  for (const auto& group : mpeg4::fap_groups) {
    if (group.number == 1) continue;
    out += row({number(group.number), range(group.first_fap, group.last_fap), std::string(group.name)});
  }
  return out;
}

std::string feature_point_group_table() {
  std::string out = header({"FP group", "FPs", "number of FPs", "dense indices"});
  const auto& points = mpeg4::feature_points;
  for (std::size_t first = 0, end = 0; first < points.size(); first = end) {
    while (end < points.size() && group_of(points[end].id) == group_of(points[first].id)) ++end;
    const auto last = static_cast<std::int64_t>(end) - 1;
    const bool one = end - first == 1;
    out += row({std::string(group_of(points[first].id)),
                one ? point_id(first) : point_id(first).append(" to ").append(point_id(end - 1)), number(end - first),
                one ? number(first) : range(static_cast<std::int64_t>(first), last)});
  }
  return out;
}

std::string feature_point_table() {
  std::string out = header({"index", "FP", "side", "mirror", "FAPs", "place"});
  for (std::size_t i = 0; i < mpeg4::feature_points.size(); ++i) {
    const mpeg4::FeaturePointInfo& point = mpeg4::feature_points[i];
    const char* const side = point.side == mpeg4::Side::left    ? "left"
                             : point.side == mpeg4::Side::right ? "right"
                                                                : "middle";
    out += row(
        {number(i), std::string(point.id), side, point_id(point.mirror), faps_that_move(i), std::string(point.name)});
  }
  return out;
}

std::string fapu_table() {
  std::string out = header({"FAPU", "1024 times its value, on the neutral face", "meaning"});
  for (const mpeg4::FapuInfo& fapu : mpeg4::fapus) {
    if (fapu.measure_count == 0) continue;  // AU, which is not a length of a face
    out += row({code(fapu.name), measures_of(fapu), std::string(fapu.meaning)});
  }
  return out;
}

std::string companion_table() {
  std::string out = header({"FP", "follows", "share", "when"});
  for (const mpeg4::Companion& companion : mpeg4::companions) {
    std::ostringstream share;
    share << companion.share;
    out += row({point_id(companion.point), point_id(companion.leader), share.str(),
                companion.is_choice ? "the player lets FAP 3 open the mouth" : "always"});
  }
  return out;
}

std::string select_table() {
  std::string out = header({"select", "viseme (FAP 1)", "phonemes", "expression (FAP 2)"});
  for (std::size_t i = 0; i < mpeg4::visemes.size(); ++i) {
    out += row({number(i), code(mpeg4::visemes[i].name), std::string(mpeg4::visemes[i].phonemes),
                i < mpeg4::expressions.size() ? code(mpeg4::expressions[i].name) : ""});
  }
  return out;
}

}  // namespace semblante::codegen
