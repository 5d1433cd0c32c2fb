#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

/// The types of members in the answer structs that are generated from openapi.json.
namespace semblante::api {

/// The JSON of answers: members keep the order of insertion. Lookup takes time linear in their number.
using Json = nlohmann::ordered_json;

namespace answer {

/// A JSON value that other code has written as text (`x-written-by` in openapi.json).
struct JsonText {
  std::string text;
};

/// An object whose member names are data, in order of insertion.
template <class T>
using Members = std::vector<std::pair<std::string, T>>;

/// A text that is one of `Words::all`.
template <class Words>
class Word {
 public:
  template <class Text>
  requires std::convertible_to<const Text&, std::string_view> Word(const Text& text)
      : text_(std::string_view(text)) {  // NOLINT: implicit by intention
    assert(std::find(Words::all.begin(), Words::all.end(), text_) != Words::all.end());
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace answer
}  // namespace semblante::api
