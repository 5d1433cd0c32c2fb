#pragma once

// For .cpp files only: the heavy JSON header stays out of every public one.

#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/types/result.h"

namespace semblante {

/// A place in a JSON text that knows its pointer. Reads by the caller's expectations; the FIRST thing that is not as
/// expected goes into the report, and reading goes on with harmless values, so that code reads like the format.
class JsonCursor {
 public:
  using Report = std::optional<Error>;

  JsonCursor(const nlohmann::json& node, std::string pointer, Report& report)
      : node_(&node), pointer_(std::move(pointer)), report_(&report) {}

  void fail(ErrorCode code, std::string message) const {
    if (!report_->has_value()) *report_ = Error{code, pointer_, std::move(message)};
  }
  [[nodiscard]] bool failed() const { return report_->has_value(); }
  [[nodiscard]] bool is_null() const { return node_->is_null(); }
  [[nodiscard]] bool is_text() const { return node_->is_string(); }
  [[nodiscard]] bool is_array() const { return node_->is_array(); }
  [[nodiscard]] bool is_empty_array() const { return node_->is_array() && node_->empty(); }
  [[nodiscard]] const std::string& pointer() const { return pointer_; }

  /// Reports `missing` when there is no such member.
  [[nodiscard]] JsonCursor member(std::string_view name) const {
    const nlohmann::json* found = find(name);
    JsonCursor child(found == nullptr ? null() : *found, pointer_ + "/" + escaped(name), *report_);
    if (found == nullptr && is_object()) child.fail(ErrorCode::missing, "is required");
    return child;
  }
  [[nodiscard]] std::optional<JsonCursor> optional_member(std::string_view name) const {
    const nlohmann::json* found = find(name);
    if (found == nullptr) return std::nullopt;
    return JsonCursor(*found, pointer_ + "/" + escaped(name), *report_);
  }
  /// Names and values of an object.
  [[nodiscard]] std::vector<std::pair<std::string_view, JsonCursor>> members() const {
    std::vector<std::pair<std::string_view, JsonCursor>> result;
    if (!is_object()) return result;
    for (const auto& [name, value] : node_->items()) {
      // `name` belongs to the iteration; the key in the tree lives on.
      const std::string_view key = node_->find(name).key();
      result.emplace_back(key, JsonCursor(value, pointer_ + "/" + escaped(key), *report_));
    }
    return result;
  }
  [[nodiscard]] std::vector<JsonCursor> elements(std::size_t least, std::size_t most) const {
    std::vector<JsonCursor> result;
    if (!node_->is_array()) return fail(ErrorCode::malformed, "must be an array, not " + kind()), result;
    if (node_->size() < least || node_->size() > most) {
      const std::string bounds =
          least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most);
      return fail(node_->size() > most ? ErrorCode::too_large : ErrorCode::out_of_range,
                  "must have " + bounds + " elements, not " + std::to_string(node_->size())),
             result;
    }
    for (std::size_t i = 0; i < node_->size(); ++i) {
      result.emplace_back((*node_)[i], pointer_ + "/" + std::to_string(i), *report_);
    }
    return result;
  }

  [[nodiscard]] double number() const {
    if (!node_->is_number()) return fail(ErrorCode::malformed, "must be a number, not " + kind()), 0.0;
    const double value = node_->get<double>();
    if (!std::isfinite(value)) return fail(ErrorCode::not_finite, "must be finite"), 0.0;
    return value;
  }
  [[nodiscard]] double number(double least, double most) const {
    const double value = number();
    if (value < least || value > most) {
      return fail(ErrorCode::out_of_range, "must be between " + text_of(least) + " and " + text_of(most)), least;
    }
    return value;
  }
  [[nodiscard]] std::uint64_t integer(std::uint64_t least, std::uint64_t most) const {
    const double value = number();
    if (failed()) return least;
    if (value != std::floor(value)) return fail(ErrorCode::malformed, "must be a whole number"), least;
    if (value < static_cast<double>(least) || value > static_cast<double>(most)) {
      return fail(ErrorCode::out_of_range, "must be between " + std::to_string(least) + " and " + std::to_string(most) +
                                               ", not " + node_->dump()),
             least;
    }
    return static_cast<std::uint64_t>(value);
  }
  [[nodiscard]] bool boolean() const {
    if (!node_->is_boolean()) return fail(ErrorCode::malformed, "must be true or false, not " + kind()), false;
    return node_->get<bool>();
  }
  [[nodiscard]] std::string text(std::size_t most_bytes) const {
    if (!node_->is_string()) return fail(ErrorCode::malformed, "must be a text, not " + kind()), std::string();
    const auto& value = node_->get_ref<const std::string&>();
    if (value.size() > most_bytes) {
      return fail(ErrorCode::too_large, "must not exceed " + std::to_string(most_bytes) + " bytes"), std::string();
    }
    return value;
  }

  /// A name as a segment of a pointer.
  static std::string escaped(std::string_view name) {
    std::string result;
    for (const char c : name) {
      if (c == '~') {
        result += "~0";
      } else if (c == '/') {
        result += "~1";
      } else {
        result += c;
      }
    }
    return result;
  }

 private:
  static const nlohmann::json& null() {
    static const nlohmann::json value;
    return value;
  }
  static std::string text_of(double value) { return nlohmann::json(value).dump(); }
  [[nodiscard]] std::string kind() const { return node_->type_name(); }
  [[nodiscard]] bool is_object() const {
    if (node_->is_object()) return true;
    return fail(ErrorCode::malformed, "must be an object, not " + kind()), false;
  }
  [[nodiscard]] const nlohmann::json* find(std::string_view name) const {
    if (!is_object()) return nullptr;
    const auto it = node_->find(std::string(name));
    return it == node_->end() ? nullptr : &*it;
  }

  const nlohmann::json* node_;
  std::string pointer_;
  Report* report_;
};

/// The tree of a text that must be an object. Errors say the byte where the text stops being JSON.
Result<nlohmann::json> parse_json_object(std::string_view text, std::size_t max_bytes);

}  // namespace semblante
