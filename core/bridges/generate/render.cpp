#include "core/bridges/generate/render.h"

#include <sstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "core/tables/mpeg4.h"

namespace semblante::bridges {
namespace {

using json = nlohmann::ordered_json;

constexpr std::array<const char*, 5> units = {"IRISD", "ES", "ENS", "MNS", "MW"};
constexpr std::array<const char*, 5> setting_names = {"eye_full_turn_degrees", "upper_lid_share", "tongue_parting",
                                                      "lip_overlap", "carried_when_shut"};

std::map<int, double> read_faps(const std::string& shape, const json& source) {
  std::map<int, double> faps;
  for (const auto& [key, value] : source.items()) {
    const int number = std::stoi(key);
    // clang 14 does not let a lambda use the names of a structured binding.
    const auto refuse = [&shape, &name = key](const char* before, const char* after) {
      throw std::runtime_error(std::string(shape).append(before).append(name).append(after));
    };
    if (number < 3 || number > 68) refuse(": no low-level FAP ", "");
    if (mpeg4::fap(static_cast<std::size_t>(number)).kind != mpeg4::FapKind::translation)
      refuse(": FAP ", " moves no point; eyes and head turn by rule");
    faps[number] = value.get<double>();
  }
  return faps;
}

std::map<int, double> mirrored(const std::map<int, double>& faps) {
  std::map<int, double> result;
  for (const auto& [number, value] : faps) {
    const mpeg4::Fap& fap = mpeg4::fap(static_cast<std::size_t>(number));
    result[fap.mirror] = fap.mirror_sign * value;
  }
  return result;
}

}  // namespace

ArkitData read_arkit_data(const std::string& file) {
  const json source = codegen::read_json(file);
  ArkitData data;
  data.rotations = source.at("rotations").get<std::vector<std::string>>();
  for (const char* const name : setting_names) data.settings[name] = source.at(name).get<double>();
  for (std::size_t u = 0; u < units.size(); ++u) data.millimetres[u] = source.at("millimetres").at(units[u]);
  std::map<std::string, std::size_t> index;
  for (const json& entry : source.at("shapes")) {
    ShapeData shape;
    shape.name = entry.at("name");
    shape.cost = entry.value("cost", 0.0);
    shape.mirror = data.shapes.size();
    if (!index.insert({shape.name, data.shapes.size()}).second) throw std::runtime_error(shape.name + " twice");
    if (entry.contains("mirror_of")) {
      const auto other = index.find(entry.at("mirror_of"));
      if (other == index.end()) throw std::runtime_error(shape.name + ": mirrors what is not before it");
      ShapeData& original = data.shapes[other->second];
      original.mirror = data.shapes.size();
      shape.mirror = other->second;
      shape.cost = original.cost;
      shape.faps = mirrored(original.faps);
    } else {
      shape.faps = read_faps(shape.name, entry.at("faps"));
    }
    data.shapes.push_back(std::move(shape));
  }
  if (data.shapes.size() != 52 || data.rotations.size() != 9)
    throw std::runtime_error(file + ": 52 shapes, 9 rotations");
  return data;
}

std::string render_cpp(const ArkitData& data) {
  std::ostringstream shapes;
  std::ostringstream entries;
  std::size_t count = 0;
  for (const ShapeData& shape : data.shapes) {
    shapes << "    {\"" << shape.name << "\", " << shape.mirror << ", " << count << ", " << shape.faps.size() << ", "
           << shape.cost << "},\n";
    entries << "    // " << shape.name << "\n";
    for (const auto& [fap, value] : shape.faps) entries << "    {" << fap << ", " << value << "},\n";
    count += shape.faps.size();
  }
  std::ostringstream out;
  out << "// Generated from core/bridges/data/arkit.json by semblante-codegen-bridges; change the data, not this.\n"
      << "// clang-format off\n#pragma once\n\n#include <array>\n#include <cstddef>\n#include <cstdint>\n"
      << "#include <string_view>\n\nnamespace semblante::generated {\n\n"
      << "struct ArkitEntry {\n  std::uint8_t fap;\n  std::int16_t value;  ///< FAP units at coefficient 1\n};\n\n"
      << "/// arkit_entries[first] .. arkit_entries[first + count - 1]; cost in square millimetres\n"
      << "struct ArkitShape {\n  std::string_view name;\n  std::uint8_t mirror;\n  std::size_t first, count;\n"
      << "  double cost;\n};\n\n";
  for (const auto& [name, value] : data.settings) {
    out << "inline constexpr double arkit_" << name << " = " << value << ";\n";
  }
  out << "/// IRISD, ES, ENS, MNS, MW on a usual head, whole units\n"
      << "inline constexpr std::array<double, 5> arkit_millimetres = {";
  for (std::size_t u = 0; u < units.size(); ++u) out << (u > 0 ? ", " : "") << data.millimetres[u];
  out << "};\n\ninline constexpr std::array<std::string_view, 9> arkit_rotations = {";
  for (std::size_t r = 0; r < data.rotations.size(); ++r) out << (r > 0 ? ", " : "") << '"' << data.rotations[r] << '"';
  out << "};\n\ninline constexpr std::array<ArkitEntry, " << count << "> arkit_entries = {{\n"
      << entries.str() << "}};\n\ninline constexpr std::array<ArkitShape, 52> arkit_shapes = {{\n"
      << shapes.str() << "}};\n\n}  // namespace semblante::generated\n";
  return out.str();
}

std::vector<codegen::GeneratedFile> generated_files(const std::string& source_folder) {
  const ArkitData data = read_arkit_data(source_folder + "/core/bridges/data/arkit.json");
  return {{"core/bridges/generated/arkit_tables.h", render_cpp(data)}};
}

}  // namespace semblante::bridges
