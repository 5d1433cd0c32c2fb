#include "core/anatomy/role_by_name.h"

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "core/types/letter_case.h"

namespace semblante {
namespace {

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

/// True if the word stands alone: "arm" in "Std_Skin_Arm", not in "Armature".
bool has_word(const std::string& name, std::string_view word) {
  const auto is_letter = [&](std::size_t i) {
    return i < name.size() && std::isalpha(static_cast<unsigned char>(name[i])) != 0;
  };
  for (std::size_t at = name.find(word); at != std::string::npos; at = name.find(word, at + 1)) {
    if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + word.size())) return true;
  }
  return false;
}

bool names_teeth(const std::string& name) { return has_any(name, {"teeth", "tooth", "gum", "denture"}); }

std::optional<PartRole> role_of_name(const std::string& name, double x) {
  // Most specific words first: "eyelash", "Eyeline" and "eyeglasses" are not eyes, "browline_glasses" are no brow.
  if (has_any(name, {"glass", "eyewear", "goggle", "spectacle"})) return PartRole::rest;
  if (has_any(name, {"lash", "eyeline", "eye_line", "brow", "tear", "lacrimal", "occlusion", "eyeblend", "eye_blend",
                     "caruncle", "fluid", "beard", "mustache", "moustache"})) {
    return PartRole::attached;
  }
  if (has_any(name, {"hair", "hat", "helmet", "headwear", "facewear", "earring"})) return PartRole::rest;
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

/// What a name says about the large surfaces of a character.
enum class Region : std::uint8_t { unknown, face, body, other };

Region region_of_name(const std::string& name) {
  if (role_of_name(name, 0.0) || names_teeth(name) || has_any(name, {"mouth"})) return Region::other;
  // Before "face" and "head", because of "headphones".
  if (has_any(name, {"body",     "torso", "outfit", "shirt", "cloth",     "shoe",    "pants",
                     "trouser",  "jeans", "skirt",  "dress", "jacket",    "sweater", "hoodie",
                     "onepiece", "glove", "sock",   "boots", "headphone", "headband"})) {
    return Region::body;
  }
  for (const std::string_view word : {"arm", "arms", "hand", "hands", "leg", "legs", "foot", "feet", "coat", "collar",
                                      "scarf", "suit", "necklace", "tie", "tops", "bottoms"}) {
    if (has_word(name, word)) return Region::body;
  }
  return has_any(name, {"face", "head"}) ? Region::face : Region::unknown;
}

/// The material decides: a mesh "Face (merged)" has materials for skin, mouth, brows and eyes.
Region region_of(const PartShape& shape) {
  const Region by_material = region_of_name(lower_case(shape.material));
  return by_material != Region::unknown ? by_material : region_of_name(lower_case(shape.name));
}

bool is_eye(std::optional<PartRole> role) { return role == PartRole::left_eye || role == PartRole::right_eye; }

/// On which sides of the face the parts of a name lie.
class SidesOfNames {
 public:
  void add(const std::string& name, double x) { (x > 0.0 ? sides_[name].left : sides_[name].right) = true; }
  [[nodiscard]] bool on_both(const std::string& name) const {
    const auto found = sides_.find(name);
    return found != sides_.end() && found->second.left && found->second.right;
  }

 private:
  struct Sides {
    bool left = false, right = false;
  };
  std::map<std::string, Sides> sides_;
};

}  // namespace

bool is_named_teeth(const PartShape& shape) {
  return names_teeth(lower_case(shape.name)) || names_teeth(lower_case(shape.material));
}

bool is_lid_name(std::string_view name) {
  const std::string lower = lower_case(name);
  return has_any(lower, {"eyelid", "eye_lid"}) || has_word(lower, "lid") || has_word(lower, "lids");
}

bool is_rigid_name(std::string_view name) { return role_of_name(lower_case(name), 0.0) == PartRole::rest; }

bool is_face_name(const PartShape& shape) { return region_of(shape) == Region::face; }

bool is_body_name(const PartShape& shape) { return region_of(shape) == Region::body; }

bool has_name_of_another_part(const PartShape& shape) { return region_of(shape) == Region::other; }

void guess_roles_by_name(std::span<const PartShape> shapes, std::span<std::optional<PartRole>> roles) {
  // On many characters the face belongs to the mesh "body"; then its other parts are not named by that word.
  bool body_is_apart = true;
  double low = 0.0;
  double high = 0.0;
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    if (roles[p] != PartRole::skin) continue;
    if (is_body_name(shapes[p])) body_is_apart = false;
  }
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    if (roles[p] != PartRole::skin) continue;
    low = shapes[p].low.x;
    high = shapes[p].high.x;
    break;
  }
  const double middle = 0.5 * (low + high);
  SidesOfNames sides;
  for (const PartShape& shape : shapes) {
    if (shape.triangles == 0) continue;
    sides.add(lower_case(shape.name), shape.center.x - middle);
    sides.add(lower_case(shape.material), shape.center.x - middle);
  }
  // One mesh that two nodes show is named after one of its eyes: where parts of a name lie on both sides, the place
  // tells which eye it is.
  const auto role_by = [&](const std::string& name, double x) {
    const std::optional<PartRole> role = role_of_name(name, x);
    if (!is_eye(role) || !sides.on_both(name)) return role;
    return std::optional(x > 0.0 ? PartRole::left_eye : PartRole::right_eye);
  };
  for (std::size_t p = 0; p < shapes.size(); ++p) {
    if (roles[p] || shapes[p].triangles == 0) continue;
    const double x = shapes[p].center.x - middle;
    roles[p] = role_by(lower_case(shapes[p].name), x);
    if (!roles[p]) roles[p] = role_by(lower_case(shapes[p].material), x);
    if (!roles[p] && body_is_apart && is_body_name(shapes[p])) roles[p] = PartRole::rest;
  }
}

}  // namespace semblante
