#include "core/tables/generate/render.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "core/types/letter_case.h"

namespace semblante::tables {
namespace {

using json = nlohmann::ordered_json;

constexpr const char* notice =
    "Generated from core/tables/data by semblante-codegen-tables; change the data, not this.";

/// Dense index of a feature point: its place in the list.
int index_of(const TableData& data, const std::string& id) {
  int index = 0;
  for (const json& point : data.feature_points["feature_points"]) {
    if (point["id"] == id) return index;
    ++index;
  }
  throw std::runtime_error("no feature point " + id);
}

/// (axis, sign) of a unit vector along an axis; (-1, 0) for null.
std::pair<int, int> axis_and_sign(const json& axis) {
  if (!axis.is_array()) return {-1, 0};
  for (int i = 0; i < 3; ++i) {
    const int component = axis[static_cast<std::size_t>(i)];
    if (component != 0) return {i, component};
  }
  throw std::runtime_error("an axis of length zero");
}

std::string quoted(const json& text) { return json(text).dump(); }

std::string joined(const json& words) {
  std::string all;
  for (const json& word : words) {
    if (!all.empty()) all += ' ';
    all += word.get<std::string>();
  }
  return all;
}

}  // namespace

TableData read_table_data(const std::string& data_folder) {
  return {codegen::read_json(data_folder + "/faps.json"), codegen::read_json(data_folder + "/feature-points.json"),
          codegen::read_json(data_folder + "/fapus.json"), codegen::read_json(data_folder + "/high-level.json"),
          codegen::read_json(data_folder + "/companions.json")};
}

std::string render_c_header(const TableData& data) {
  std::ostringstream out;
  out << "/* " << notice << " */\n/* clang-format off */\n"
      << "#ifndef SEMBLANTE_MPEG4_TABLES_H\n#define SEMBLANTE_MPEG4_TABLES_H\n\n#include <stdint.h>\n\n"
      << "#define SEMBLANTE_FAP_HIGH_LEVEL 0 /* a displacement set: nothing of one point alone */\n"
      << "#define SEMBLANTE_FAP_TRANSLATION 1\n#define SEMBLANTE_FAP_ROTATION 2\n"
      << "#define SEMBLANTE_FAP_PUPIL 3 /* the diameter of a pupil changes */\n"
      << "#define SEMBLANTE_FAP_ROLL 4  /* the borders of the tongue turn up */\n\n"
      << "#define SEMBLANTE_FP_LEFT_PUPIL " << index_of(data, "3.5") << "\n"
      << "#define SEMBLANTE_FP_RIGHT_PUPIL " << index_of(data, "3.6") << "\n"
      << "/* The point of the right eye is the next one. */\n"
      << "#define SEMBLANTE_FP_LEFT_UPPER_LID " << index_of(data, "3.1") << "\n"
      << "#define SEMBLANTE_FP_LEFT_LOWER_LID " << index_of(data, "3.3") << "\n\n"
      << "/* displacement (or angle) = sign * value * unit along (or about) the axis */\n"
      << "typedef struct semblante_fap_entry {\n"
      << "  uint8_t kind; /* SEMBLANTE_FAP_* */\n"
      << "  uint8_t fp;   /* dense index of the feature point */\n"
      << "  uint8_t axis; /* 0 x, 1 y, 2 z; 0 for pupils and roll, which have none */\n"
      << "  int8_t sign;\n"
      << "  uint8_t unit; /* 0 IRISD, 1 ES, 2 ENS, 3 MNS, 4 MW, 5 AU */\n"
      << "} semblante_fap_entry;\n\n"
      << "/* By FAP number; entry 0 is not a FAP. */\n"
      << "static const semblante_fap_entry semblante_fap_table[" << data.faps["faps"].size() + 1 << "] = {\n"
      << "    {SEMBLANTE_FAP_HIGH_LEVEL, 0, 0, 0, 0},\n";
  std::vector<std::string> units;
  for (const json& fapu : data.fapus["fapus"]) units.push_back(fapu["name"]);
  for (const json& fap : data.faps["faps"]) {
    const std::string kind = fap["kind"];
    if (kind == "high_level") {
      out << "    {SEMBLANTE_FAP_HIGH_LEVEL, 0, 0, 0, 0}";
    } else {
      const auto [axis, sign] = axis_and_sign(fap.value("axis", json()));
      const std::string unit_name = fap["unit"];
      std::size_t unit = 0;
      while (unit < units.size() && units[unit] != unit_name) ++unit;
      if (unit == units.size()) throw std::runtime_error("no unit is called " + unit_name);
      const char* const motion = kind == "translation" ? "TRANSLATION"
                                 : kind == "scale"     ? "PUPIL"
                                 : axis < 0            ? "ROLL"
                                                       : "ROTATION";
      out << "    {SEMBLANTE_FAP_" << motion << ", " << index_of(data, fap["feature_points"][0]) << ", "
          << std::max(axis, 0) << ", " << (axis < 0 ? 1 : sign) << ", " << unit << "}";
    }
    out << ", /* " << fap["number"] << " " << fap["name"].get<std::string>() << " */\n";
  }
  out << "};\n\n#endif\n";
  return out.str();
}

std::string render_cpp_header(const TableData& data) {
  std::ostringstream out;
  out << "// " << notice << "\n// clang-format off\n#pragma once\n\n#include \"core/tables/mpeg4.h\"\n\n"
      << "namespace semblante::mpeg4 {\n\n";
  const auto array = [&out](const char* type, const char* name, std::size_t size) {
    out << "inline constexpr std::array<" << type << ", " << size << "> " << name << " = {{\n";
  };
  array("FapGroup", "fap_groups", data.faps["groups"].size());
  for (const json& group : data.faps["groups"]) {
    out << "    {" << group["group"] << ", " << quoted(group["name"]) << ", " << group["first"] << ", " << group["last"]
        << "},\n";
  }
  out << "}};\n\n";
  array("Fap", "faps", data.faps["faps"].size());
  for (const json& fap : data.faps["faps"]) {
    const auto [axis, sign] = axis_and_sign(fap.value("axis", json()));
    const json points = fap.value("feature_points", json::array());
    const json levels = fap.value("levels", json::array({0, 0}));
    const json usual = fap.value("usual", json::array({0, 0}));
    out << "    {" << fap["number"] << ", " << quoted(fap["name"]) << ", " << fap["group"]
        << ", FapKind::" << fap["kind"].get<std::string>() << ", Unit::" << lower_case(fap.value("unit", "none"))
        << ", " << (fap.value("directionality", "U") == "B" ? "true" : "false") << ", " << axis << ", " << sign
        << ", {";
    for (std::size_t i = 0; i < points.size(); ++i) out << (i == 0 ? "" : ", ") << index_of(data, points[i]);
    out << "}, " << points.size() << ", " << fap.value("mirror", 0) << ", " << fap.value("mirror_sign", 0) << ", "
        << fap.value("quantizer_step", 1) << ", " << levels[0] << ", " << levels[1] << ", " << usual[0] << ", "
        << usual[1] << "},\n";
  }
  out << "}};\n\n// Apart, so that a program without use for them does not contain them.\n";
  array("std::string_view", "fap_descriptions", data.faps["faps"].size());
  for (const json& fap : data.faps["faps"]) out << "    " << quoted(fap["description"]) << ",\n";
  out << "}};\n\n";
  array("FeaturePointInfo", "feature_points", data.feature_points["feature_points"].size());
  for (const json& point : data.feature_points["feature_points"]) {
    out << "    {" << quoted(point["id"]) << ", " << quoted(point["name"])
        << ", Side::" << point["side"].get<std::string>() << ", " << index_of(data, point["mirror"]) << "},\n";
  }
  out << "}};\n\n";
  array("std::string_view", "quick_set", data.feature_points["quick_set"].size());
  for (const json& id : data.feature_points["quick_set"]) out << "    " << quoted(id) << ",\n";
  out << "}};\n\n";
  array("FapuInfo", "fapus", data.fapus["fapus"].size());
  for (const json& fapu : data.fapus["fapus"]) {
    const json measures = fapu.value("measures", json::array());
    out << "    {" << quoted(fapu["name"]) << ", " << quoted(fapu["meaning"]) << ", {{";
    for (std::size_t i = 0; i < measures.size(); ++i) {
      out << (i == 0 ? "" : ", ") << "{" << index_of(data, measures[i]["from"]) << ", "
          << index_of(data, measures[i]["to"]) << ", " << measures[i]["axis"] << "}";
    }
    out << "}}, " << measures.size() << "},\n";
  }
  out << "}};\n\n";
  array("VisemeInfo", "visemes", data.high_level["visemes"].size());
  for (const json& viseme : data.high_level["visemes"]) {
    out << "    {" << quoted(viseme["name"]) << ", " << quoted(joined(viseme["phonemes"])) << ", "
        << quoted(joined(viseme["examples"])) << "},\n";
  }
  out << "}};\n\n";
  array("ExpressionInfo", "expressions", data.high_level["expressions"].size());
  for (const json& expression : data.high_level["expressions"]) {
    out << "    {" << quoted(expression["name"]) << "},\n";
  }
  out << "}};\n\n";
  array("Companion", "companions", data.companions["companions"].size() + data.companions["lower_lip"].size());
  for (const char* const list : {"companions", "lower_lip"}) {
    for (const json& entry : data.companions[list]) {
      out << "    {" << index_of(data, entry["point"]) << ", " << index_of(data, entry["follows"]) << ", "
          << entry["share"] << ", " << (list == std::string_view("lower_lip") ? "true" : "false") << "},\n";
    }
  }
  out << "}};\n\n}  // namespace semblante::mpeg4\n";
  return out.str();
}

std::string render_typescript(const TableData& data) {
  std::ostringstream out;
  out << "// " << notice << R"(

export type FapKind = "high_level" | "translation" | "rotation" | "scale";
export type FapUnit = "IRISD" | "ES" | "ENS" | "MNS" | "MW" | "AU";
export type Side = "center" | "left" | "right";

export interface FapGroup {
  readonly number: number;
  readonly name: string;
  readonly first: number;
  readonly last: number;
}

export interface Fap {
  /** 1..68 */
  readonly number: number;
  readonly name: string;
  readonly description: string;
  readonly group: number;
  readonly kind: FapKind;
  /** null for FAPs 1 and 2 */
  readonly unit: FapUnit | null;
  readonly bidirectional: boolean;
  /** 0 x, 1 y, 2 z; null where the FAP moves or turns nothing along one axis */
  readonly axis: 0 | 1 | 2 | null;
  /** displacement (or angle) = sign * value * unit along (or about) the axis */
  readonly sign: -1 | 0 | 1;
  readonly featurePoints: readonly string[];
  /** To mirror a frame: new[mirror] = mirrorSign * old[number]; 0 for FAPs 1 and 2. */
  readonly mirror: number;
  readonly mirrorSign: -1 | 0 | 1;
  readonly quantizerStep: number;
  /** Range the wire carries, FAP units. */
  readonly min: number;
  readonly max: number;
  /** What a face does, FAP units: the range of a slider. */
  readonly usualMin: number;
  readonly usualMax: number;
}

export interface FeaturePoint {
  readonly id: string;
  readonly side: Side;
  /** id of the point on the other side; its own in the middle */
  readonly mirror: string;
}

/** Coordinate `axis` (0 x, 1 y, 2 z) of `to` minus that of `from`, on the neutral face. */
export interface FapuMeasure {
  readonly from: string;
  readonly to: string;
  readonly axis: 0 | 1;
}

export interface Fapu {
  readonly name: FapUnit;
  readonly meaning: string;
  /** The unit is 1024th of their mean; two: left and right eye; none: an angle. */
  readonly measures: readonly FapuMeasure[];
}

export interface Viseme {
  readonly name: string;
  /** IPA */
  readonly phonemes: readonly string[];
  readonly examples: readonly string[];
}

export interface Expression {
  readonly name: string;
  readonly description: string;
}

)";
  const auto list = [&out](const char* type, const char* name, const json& rows) {
    out << "export const " << name << ": readonly " << type << "[] = [\n";
    for (const json& row : rows) out << "  " << row.dump() << ",\n";
    out << "];\n\n";
  };
  out << "export const fapCount = " << data.faps["faps"].size() << ";\n"
      << "export const featurePointCount = " << data.feature_points["feature_points"].size() << ";\n\n";
  json steps = json::array();
  for (const json& f : data.faps["faps"]) steps.push_back(f.value("quantizer_step", 1));
  out << "/** `quantizerStep` of FAPs 1 to 68, for pages that need nothing else of them. */\n"
      << "export const quantizerSteps: readonly number[] = " << steps.dump() << ";\n\n";
  json groups = json::array();
  for (const json& g : data.faps["groups"]) {
    groups.push_back({{"number", g["group"]}, {"name", g["name"]}, {"first", g["first"]}, {"last", g["last"]}});
  }
  json faps = json::array();
  for (const json& f : data.faps["faps"]) {
    const auto [axis, sign] = axis_and_sign(f.value("axis", json()));
    const int step = f.value("quantizer_step", 1);
    const json levels = f.value("levels", json::array({0, 0}));
    const json usual = f.value("usual", json::array({0, 0}));
    faps.push_back({{"number", f["number"]},
                    {"name", f["name"]},
                    {"description", f["description"]},
                    {"group", f["group"]},
                    {"kind", f["kind"]},
                    {"unit", f.value("unit", json())},
                    {"bidirectional", f.value("directionality", "U") == "B"},
                    {"axis", axis < 0 ? json() : json(axis)},
                    {"sign", sign},
                    {"featurePoints", f.value("feature_points", json::array())},
                    {"mirror", f.value("mirror", 0)},
                    {"mirrorSign", f.value("mirror_sign", 0)},
                    {"quantizerStep", step},
                    {"min", levels[0].get<int>() * step},
                    {"max", levels[1].get<int>() * step},
                    {"usualMin", usual[0]},
                    {"usualMax", usual[1]}});
  }
  json fapus = json::array();
  for (const json& f : data.fapus["fapus"]) {
    fapus.push_back({{"name", f["name"]}, {"meaning", f["meaning"]}, {"measures", f.value("measures", json::array())}});
  }
  list("FapGroup", "fapGroups", groups);
  out << "/** faps[n - 1] is FAP n. */\n";
  list("Fap", "faps", faps);
  out << "/** In the order of the standard: the index is the dense feature point index of the formats. */\n";
  json points = json::array();
  json names = json::array();
  for (json point : data.feature_points["feature_points"]) {
    names.push_back(point["name"]);
    point.erase("name");
    points.push_back(point);
  }
  list("FeaturePoint", "featurePoints", points);
  out << "/** Of featurePoints, at the same index: for people who place them. */\n";
  list("string", "featurePointNames", names);
  out << "/** The points to mark first, in this order: the others are proposed from them. */\n";
  list("string", "quickSet", data.feature_points["quick_set"]);
  list("Fapu", "fapus", fapus);
  out << "/** By the number that FAP 1 selects. */\n";
  list("Viseme", "visemes", data.high_level["visemes"]);
  out << "/** By the number that FAP 2 selects; 0 is none. */\n";
  list("Expression", "expressions", data.high_level["expressions"]);
  std::string text = out.str();
  text.pop_back();  // one newline at the end
  return text;
}

std::vector<codegen::GeneratedFile> generated_files(const std::string& source_folder) {
  const TableData data = read_table_data(source_folder + "/core/tables/data");
  return {{"core/tables/generated/mpeg4_tables.h", render_c_header(data)},
          {"core/tables/generated/mpeg4_entries.h", render_cpp_header(data)},
          {"protocol/ts/generated/mpeg4.ts", render_typescript(data)}};
}

}  // namespace semblante::tables
