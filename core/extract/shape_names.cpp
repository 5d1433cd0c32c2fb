#include "core/extract/shape_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <vector>

#include "core/bridges/arkit.h"
#include "core/bridges/oculus.h"
#include "core/expressions/library.h"
#include "core/types/letter_case.h"

namespace semblante {
namespace {

struct Alias {
  std::string_view word;
  SetKind kind;
  std::string_view name;  ///< of the library
};

constexpr SetKind v = SetKind::viseme;
constexpr SetKind e = SetKind::expression;
/// Names beside Oculus Lipsync's (find_oculus): VRM's five vowels (0.x and 1.0), and expressions as VRM, VRoid and
/// avatar makers call them.
constexpr std::array aliases = std::to_array<Alias>({
    {"ee", v, "e"},
    {"a", v, "a"},
    {"i", v, "i"},
    {"o", v, "o"},
    {"u", v, "u"},
    {"happy", e, "joy"},
    {"happiness", e, "joy"},
    {"joy", e, "joy"},
    {"sad", e, "sadness"},
    {"sadness", e, "sadness"},
    {"sorrow", e, "sadness"},
    {"angry", e, "anger"},
    {"anger", e, "anger"},
    {"fear", e, "fear"},
    {"afraid", e, "fear"},
    {"scared", e, "fear"},
    {"disgust", e, "disgust"},
    {"disgusted", e, "disgust"},
    {"surprise", e, "surprise"},
    {"surprised", e, "surprise"},
});
/// Words that may stand before: where the shape belongs, not which part of the face it moves.
constexpr std::array<std::string_view, 9> before_visemes = {"fcl",   "mth",   "vrc",  "v",   "viseme",
                                                            "mouth", "vowel", "head", "face"};
constexpr std::array<std::string_view, 9> before_expressions = {"fcl",     "all", "vrm",  "expression", "expressions",
                                                                "emotion", "exp", "head", "face"};

/// "Face.Fcl_MTH_A" to face, fcl, mth, a.
std::vector<std::string> words_of(std::string_view name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      words.back() += lower_case(c);
    } else if (!words.back().empty()) {
      words.emplace_back();
    }
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

std::optional<std::size_t> number_in(std::span<const DisplacementSet> library, std::string_view name) {
  for (std::size_t n = 1; n < library.size(); ++n) {
    if (library[n].name == name) return n;
  }
  return std::nullopt;
}

std::optional<NamedFace> face_of_word(std::string_view word) {
  // Oculus Lipsync's visemes have the numbers of FAP 1; silence is no shape.
  if (const auto number = find_oculus(word); number && *number > 0) return NamedFace{SetKind::viseme, *number};
  const auto* const alias =
      std::find_if(aliases.begin(), aliases.end(), [&](const Alias& known) { return known.word == word; });
  if (alias == aliases.end()) return std::nullopt;
  const auto number = number_in(library_of(alias->kind), alias->name);
  return number ? std::optional(NamedFace{alias->kind, *number}) : std::nullopt;
}

}  // namespace

std::optional<NamedFace> face_of_shape_name(std::string_view name) {
  for (const SetKind kind : {SetKind::viseme, SetKind::expression}) {
    if (const auto number = number_in(library_of(kind), name)) return NamedFace{kind, *number};
  }
  const std::vector<std::string> words = words_of(name);
  if (words.empty()) return std::nullopt;
  const auto face = face_of_word(words.back());
  if (!face) return std::nullopt;
  const auto& allowed = face->kind == SetKind::viseme ? before_visemes : before_expressions;
  const bool is_whole_face = std::all_of(words.begin(), words.end() - 1, [&](const std::string& word) {
    return std::find(allowed.begin(), allowed.end(), word) != allowed.end();
  });
  return is_whole_face ? face : std::nullopt;
}

std::optional<std::size_t> arkit_of_shape_name(std::string_view name) {
  if (const auto found = find_arkit(name)) return found;
  for (const auto& [end, side] : {std::pair{"_L", "Left"}, std::pair{"_R", "Right"}}) {
    if (name.ends_with(end)) return find_arkit(std::string(name.substr(0, name.size() - 2)) + side);
  }
  return std::nullopt;
}

}  // namespace semblante
