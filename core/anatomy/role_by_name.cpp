#include "core/anatomy/role_by_name.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string>
#include <string_view>

namespace semblante {
namespace {

std::string lower_case(std::string_view name) {
  std::string text(name);
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

bool has_any(const std::string& name, std::initializer_list<std::string_view> words) {
  return std::any_of(words.begin(), words.end(), [&](std::string_view w) { return name.find(w) != std::string::npos; });
}

/// "eye_l", "l_eye", "eyeleft", "eye.l": a single letter counts only next to a separator or at the end.
bool has_side(const std::string& name, std::string_view word, char letter) {
  if (name.find(word) != std::string::npos) return true;
  const auto apart = [&](std::size_t i) {
    return i >= name.size() || std::isalpha(static_cast<unsigned char>(name[i])) == 0;
  };
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] == letter && apart(i + 1) && (i == 0 || apart(i - 1))) return true;
  }
  return false;
}

bool names_teeth(const std::string& name) { return has_any(name, {"teeth", "tooth", "gum", "denture"}); }

std::optional<PartRole> role_of_name(const std::string& name, double x) {
  // Most specific words first: "eyelash" and "eyeglasses" are not eyes.
  if (has_any(name, {"lash", "brow", "tear", "lacrimal", "occlusion", "eyeblend", "eye_blend", "caruncle", "fluid",
                     "beard", "mustache", "moustache"})) {
    return PartRole::attached;
  }
  if (has_any(name, {"hair", "glass", "hat", "helmet", "eyewear", "outfit", "shirt", "cloth", "earring"})) {
    return PartRole::rest;
  }
  if (has_any(name, {"tongue"})) return PartRole::tongue;  // with or without gums: see jaw_share.h
  if (names_teeth(name)) {
    if (has_any(name, {"upper", "top"})) return PartRole::upper_teeth;
    if (has_any(name, {"lower", "bottom"})) return PartRole::lower_teeth;
    return std::nullopt;
  }
  if (has_any(name, {"iris", "sclera", "cornea", "pupil", "eyeball"}) ||
      (has_any(name, {"eye"}) && !has_any(name, {"lid", "socket", "shadow"}))) {
    if (has_side(name, "left", 'l')) return PartRole::left_eye;
    if (has_side(name, "right", 'r')) return PartRole::right_eye;
    return x > 0.0 ? PartRole::left_eye : PartRole::right_eye;
  }
  return std::nullopt;
}

}  // namespace

bool is_named_teeth(const PartShape& shape) {
  return names_teeth(lower_case(shape.name)) || names_teeth(lower_case(shape.material));
}

void guess_roles_by_name(std::span<const PartShape> shapes, std::span<std::optional<PartRole>> roles) {
  double low = 0.0;
  double high = 0.0;
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    if (roles[p] != PartRole::skin) continue;
    low = shapes[p].low.x;
    high = shapes[p].high.x;
    break;
  }
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    if (roles[p] || shapes[p].triangles == 0) continue;
    const double x = shapes[p].center.x - 0.5 * (low + high);
    roles[p] = role_of_name(lower_case(shapes[p].name), x);
    if (!roles[p]) roles[p] = role_of_name(lower_case(shapes[p].material), x);
  }
}

}  // namespace semblante
