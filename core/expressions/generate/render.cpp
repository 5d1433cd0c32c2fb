#include "core/expressions/generate/render.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "core/tables/mpeg4.h"

namespace semblante::expressions {
namespace {

using json = nlohmann::ordered_json;
using Displacements = std::map<FeaturePointId, Vec3>;

FeaturePointId mirror_of(FeaturePointId point) { return FeaturePointId(mpeg4::feature_points[point.value()].mirror); }

/// "2.4": [x, y, z] of a left or middle point; the right side mirrors the left unless it is given too.
Displacements read_displacements(const json& source) {
  Displacements result;
  for (const auto& [key, value] : source.items()) {
    const auto point = parse_feature_point(key);
    if (!point) throw std::runtime_error("no feature point " + key);
    result[*point] = value.get<Vec3>();
  }
  const Displacements given = result;
  for (const auto& [point, d] : given) result.insert({mirror_of(point), Vec3{-d[0], d[1], d[2]}});
  return result;
}

void add(Displacements& to, const Displacements& what, double amount) {
  for (const auto& [point, d] : what) {
    Vec3& sum = to.insert({point, Vec3{}}).first->second;
    for (std::size_t i = 0; i < 3; ++i) sum[i] += amount * d[i];
  }
}

std::map<std::string, Displacements> read_actions(const std::string& path) {
  std::map<std::string, Displacements> actions;
  const json file = codegen::read_json(path);
  for (const json& action : file.at("actions")) {
    const std::string name = action.at("name");
    if (!actions.insert({name, read_displacements(action.at("displacements"))}).second) {
      throw std::runtime_error(std::string(path).append(": action ").append(name).append(" twice"));
    }
  }
  return actions;
}

constexpr const char* jaw_open = "jaw_open";

AuthoredSet read_set(const json& entry, const std::map<std::string, Displacements>& actions) {
  const json amounts = entry.value("actions", json::object());
  AuthoredSet set{entry.at("name"), {}, entry.value("meets_upper_teeth", false), amounts.value(jaw_open, 0.0)};
  for (const auto& [name, amount] : amounts.items()) {
    const auto action = actions.find(name);
    if (action == actions.end()) throw std::runtime_error(set.name + ": no action " + name);
    add(set.displacements, action->second, amount.get<double>());
  }
  add(set.displacements, read_displacements(entry.value("displacements", json::object())), 1.0);
  // Whole units are precise enough (a unit is about 0.02 mm) and readable.
  for (auto& [point, d] : set.displacements) {
    for (double& component : d) component = std::round(component) + 0.0;  // + 0.0: no negative zero
  }
  std::erase_if(set.displacements, [](const auto& item) { return item.second == Vec3{}; });
  return set;
}

/// A motion of eyes, cheeks or nose below this is not noticed while the mouth moves; FAPU units.
constexpr double unseen = 50.0;

/// If a viseme and an expression move the same point, Eq. 5 keeps only 15 % of the expression. So a viseme omits points
/// of eyes, cheek bones and nose with displacements too small to notice: a smile keeps its cheek bones during speech.
/// The soft cheeks (5.1, 5.2) stay with the corners of the mouth, which pull them and are in every viseme: if only some
/// visemes moved them, the cheeks of a smile would rise and fall from sound to sound.
void leave_to_expressions(AuthoredSet& viseme) {
  std::erase_if(viseme.displacements, [](const auto& item) {
    const auto& [point, d] = item;
    const int group = group_of(point);
    const bool teeth = group == 9 && number_of(point) >= 8 && number_of(point) <= 11;
    const bool soft_cheek = group == 5 && number_of(point) <= 2;
    if (group == 2 || group == 6 || group == 8 || teeth || soft_cheek) return false;
    return std::hypot(d[0], d[1], d[2]) < unseen;
  });
}

template <class Infos>
std::vector<AuthoredSet> read_list(const std::string& path, const char* key, const Infos& infos,
                                   const std::map<std::string, Displacements>& actions) {
  std::vector<AuthoredSet> sets;
  const json file = codegen::read_json(path);
  try {
    for (const json& entry : file.at(key)) {
      sets.push_back(read_set(entry, actions));
      if (sets.size() > infos.size() || sets.back().name != infos[sets.size() - 1].name) {
        throw std::runtime_error("entry " + std::to_string(sets.size() - 1) + " is out of order");
      }
    }
  } catch (const std::exception& fault) {
    throw std::runtime_error(path + ": " + fault.what());
  }
  if (sets.size() != infos.size()) throw std::runtime_error(path + ": entries are missing");
  return sets;
}

}  // namespace

Sets read_sets(const std::string& data_folder) {
  const auto actions = read_actions(data_folder + "/actions.json");
  std::vector<AuthoredSet> visemes = read_list(data_folder + "/visemes.json", "visemes", mpeg4::visemes, actions);
  for (AuthoredSet& viseme : visemes) leave_to_expressions(viseme);
  std::vector<AuthoredSet> expressions =
      read_list(data_folder + "/expressions.json", "expressions", mpeg4::expressions, actions);
  for (AuthoredSet& expression : expressions) expression.jaw_open = 0.0;
  return {{jaw_open, actions.at(jaw_open)}, std::move(visemes), std::move(expressions)};
}

std::string render_header(const Sets& sets) {
  std::ostringstream entries;
  std::ostringstream tables;
  std::size_t count = 0;
  const auto table = [&](const char* name, const std::vector<AuthoredSet>& list) {
    tables << "inline constexpr std::array<Set, " << list.size() << "> " << name << " = {{\n";
    for (const AuthoredSet& set : list) {
      const std::size_t first = count;
      entries << "    // " << set.name << "\n";
      const Displacements& moved = set.displacements;
      for (auto at = moved.begin(); at != moved.end(); ++at, ++count) {
        const auto& [point, d] = *at;
        const auto next = std::next(at);
        const bool with_mirror = next != moved.end() && next->first == mirror_of(point) &&
                                 next->first.value() == point.value() + 1 && next->second == Vec3{-d[0], d[1], d[2]};
        entries << "    {" << static_cast<int>(point.value()) << (with_mirror ? ", true, " : ", false, ") << d[0]
                << ", " << d[1] << ", " << d[2] << "},  // " << to_string(point);
        if (with_mirror) entries << ", " << to_string((++at)->first);
        entries << "\n";
      }
      tables << "    {\"" << set.name << "\", " << first << ", " << count - first
             << (set.meets_upper_teeth ? ", true, " : ", false, ") << set.jaw_open << "},\n";
    }
    tables << "}};\n\n";
  };
  table("jaw_open", {sets.jaw_open});
  table("visemes", sets.visemes);
  table("expressions", sets.expressions);

  std::ostringstream out;
  out << "// Generated from core/expressions/data by semblante-codegen-expressions; change the data, not this.\n"
      << "// clang-format off\n#pragma once\n\n#include <array>\n#include <cstddef>\n#include <cstdint>\n"
      << "#include <string_view>\n\nnamespace semblante::generated {\n\n"
      << "struct Entry {\n  std::uint8_t point;  ///< dense index\n  bool with_mirror;  ///< the next point moves "
         "likewise, to the other side\n  std::int16_t x, y, z;  ///< FAPU units\n};\n\n"
      << "/// displacements[first] .. displacements[first + count - 1]\n"
      << "struct Set {\n  std::string_view name;\n  std::size_t first, count;\n  bool meets_upper_teeth;\n  double "
         "jaw_open;  ///< amount of the action\n};\n\n"
      << "inline constexpr std::array<Entry, " << count << "> displacements = {{\n"
      << entries.str() << "}};\n\n"
      << tables.str() << "}  // namespace semblante::generated\n";
  return out.str();
}

std::vector<codegen::GeneratedFile> generated_files(const std::string& source_folder) {
  const Sets sets = read_sets(source_folder + "/core/expressions/data");
  return {{"core/expressions/generated/displacement_sets.h", render_header(sets)}};
}

}  // namespace semblante::expressions
