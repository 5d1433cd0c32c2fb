#include "core/parametrize/fapu.h"

#include <array>
#include <cassert>
#include <span>
#include <string_view>

#include "core/anatomy/point_lookup.h"

namespace semblante {
namespace {

/// A difference of one coordinate of two points: the length of a unit on the neutral face, times 1024.
struct Span {
  std::string_view from, to;
  int axis;
};

constexpr int x = 0;
constexpr int y = 1;

struct Definition {
  std::array<Span, 2> spans;  ///< the unit is their mean; the second is empty for units with one span
  std::string_view needed_for;
};

/// In the order of FapuUnit.
constexpr std::array<Definition, fapu_unit_count> definitions = {{
    {{{{"3.1", "3.3", y}, {"3.2", "3.4", y}}}, "FAPs of eyelids and pupils (19-22, 29, 30)"},
    {{{{"3.5", "3.6", x}, {}}}, "FAPs of eyeball thrust and sideways brows (27, 28, 37-40)"},
    {{{{"3.5", "9.15", y}, {}}}, "FAPs of brows, cheeks, nose and ears (31-36, 41, 42, 61-68)"},
    {{{{"9.15", "2.2", y}, {}}},
     "FAPs of mouth, jaw and tongue, vertical and forward (3-5, 8-14, 16-18, 44, "
     "46, 51, 52, 55-60)"},
    {{{{"8.3", "8.4", x}, {}}}, "FAPs of mouth, jaw and tongue, sideways (6, 7, 15, 43, 45, 53, 54)"},
}};

/// A FAP value of 1024 moves a point by the whole distance (mpeg4/fapu.json, "divisor").
constexpr double divisor = 1024.0;

std::optional<double> measure(const Span& span, const FeaturePointSet& points) {
  if (span.from.empty()) return std::nullopt;
  const FeaturePoint* const from = find_point(points, span.from);
  const FeaturePoint* const to = find_point(points, span.to);
  if (from == nullptr || to == nullptr) return std::nullopt;
  return static_cast<double>(from->position[span.axis]) - static_cast<double>(to->position[span.axis]);
}

}  // namespace

Fapu compute_fapu(const FeaturePointSet& points) {
  Fapu fapu;
  for (std::size_t unit = 0; unit < fapu_unit_count; ++unit) {
    double sum = 0.0;
    int count = 0;
    for (const Span& span : definitions[unit].spans) {
      const std::optional<double> length = measure(span, points);
      if (!length) continue;
      sum += *length;
      ++count;
    }
    if (count > 0 && sum > 0.0) fapu.value[unit] = sum / count / divisor;
  }
  return fapu;
}

std::vector<std::string> explain_missing_fapu(const Fapu& fapu, const FeaturePointSet& points) {
  std::vector<std::string> sentences;
  for (std::size_t unit = 0; unit < fapu_unit_count; ++unit) {
    if (fapu.value[unit]) continue;
    const Definition& definition = definitions[unit];
    const Span& first = definition.spans[0];
    std::string sentence(fapu_unit_names[unit]);
    sentence += " cannot be measured: ";
    if (measure(first, points) || measure(definition.spans[1], points)) {
      sentence += std::string(first.from) + (first.axis == x ? " is not to the left of " : " is not above ");
      sentence += first.to;
    } else {
      std::string missing;
      for (const std::string_view id : {first.from, first.to}) {
        if (find_point(points, id) != nullptr) continue;
        if (!missing.empty()) missing += " and ";
        missing += id;
      }
      sentence += missing + (missing.find(' ') == std::string::npos ? " is not marked" : " are not marked");
    }
    sentence += "; without it these do nothing: ";
    sentence += definition.needed_for;
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

}  // namespace semblante
