#include "core/json/json_cursor.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "core/json/json_pointer.h"

namespace semblante {
namespace {

using nlohmann::json;

const json& null_value() {
  static const json value;
  return value;
}

std::string kind_of(const json& value) {
  switch (value.type()) {
    case json::value_t::object:
      return "an object";
    case json::value_t::array:
      return "an array";
    case json::value_t::string:
      return "a string";
    case json::value_t::boolean:
      return "true or false";
    case json::value_t::null:
      return "null";
    default:
      return "a number";
  }
}

std::string text_of(double value) { return json(value).dump(); }

}  // namespace

void JsonCursor::fail(ErrorCode code, std::string message) const {
  if (!failed()) *report_ = Error{code, pointer_, std::move(message)};
}

bool JsonCursor::is_null() const { return node_->is_null(); }
bool JsonCursor::is_text() const { return node_->is_string(); }
bool JsonCursor::is_array() const { return node_->is_array(); }
bool JsonCursor::is_empty_array() const { return node_->is_array() && node_->empty(); }

void JsonCursor::must_be_object() const {
  if (!node_->is_object()) fail(ErrorCode::malformed, "must be an object, not " + kind_of(*node_));
}

JsonCursor JsonCursor::child(const json* node, std::string_view name) const {
  std::string pointer = pointer_;
  append_to_pointer(pointer, name);
  return {node == nullptr ? null_value() : *node, std::move(pointer), *report_};
}

const json* JsonCursor::find(std::string_view name) const {
  if (!node_->is_object()) return nullptr;
  const auto found = node_->find(name);
  return found == node_->end() ? nullptr : &*found;
}

JsonCursor JsonCursor::member(std::string_view name) const {
  must_be_object();
  const json* const found = find(name);
  JsonCursor member = child(found, name);
  if (found == nullptr) member.fail(ErrorCode::missing, "is missing");
  return member;
}

std::optional<JsonCursor> JsonCursor::optional_member(std::string_view name) const {
  must_be_object();
  const json* const found = find(name);
  return found == nullptr ? std::nullopt : std::optional(child(found, name));
}

std::vector<std::pair<std::string_view, JsonCursor>> JsonCursor::members() const {
  std::vector<std::pair<std::string_view, JsonCursor>> members;
  must_be_object();
  if (!node_->is_object()) return members;
  for (const auto& [name, value] : node_->get_ref<const json::object_t&>())
    members.emplace_back(name, child(&value, name));
  return members;
}

std::size_t JsonCursor::size() const {
  if (node_->is_array()) return node_->size();
  fail(ErrorCode::malformed, "must be an array, not " + kind_of(*node_));
  return 0;
}

JsonCursor JsonCursor::element(std::size_t index) const {
  std::string pointer = pointer_;
  append_to_pointer(pointer, index);
  const bool is_there = index < size();
  JsonCursor element(is_there ? (*node_)[index] : null_value(), std::move(pointer), *report_);
  if (!is_there) element.fail(ErrorCode::missing, "is missing");
  return element;
}

std::vector<JsonCursor> JsonCursor::elements(std::size_t least, std::size_t most) const {
  std::vector<JsonCursor> elements;
  const std::size_t count = size();
  if (!node_->is_array()) return elements;
  if (count < least || count > most) {
    const std::string bounds =
        least == most ? std::to_string(least) : std::to_string(least) + " to " + std::to_string(most);
    fail(count > most ? ErrorCode::too_large : ErrorCode::out_of_range,
         "must have " + bounds + " elements, not " + std::to_string(count));
    return elements;
  }
  elements.reserve(count);
  for (std::size_t i = 0; i < count; ++i) elements.push_back(element(i));
  return elements;
}

double JsonCursor::number() const {
  if (!node_->is_number()) return fail(ErrorCode::malformed, "must be a number, not " + kind_of(*node_)), 0.0;
  const auto value = node_->get<double>();
  if (!std::isfinite(value)) return fail(ErrorCode::not_finite, "must be finite"), 0.0;
  return value;
}

double JsonCursor::number(double least, double most) const {
  const double value = number();
  if (value >= least && value <= most) return value;
  fail(ErrorCode::out_of_range, "must be between " + text_of(least) + " and " + text_of(most));
  return least;
}

std::uint64_t JsonCursor::integer(std::uint64_t least, std::uint64_t most) const {
  const auto refuse = [&](ErrorCode code, const std::string& message) { return fail(code, message), least; };
  if (!node_->is_number()) return refuse(ErrorCode::malformed, "must be a whole number, not " + kind_of(*node_));
  std::uint64_t value = 0;
  bool fits = true;
  if (node_->is_number_unsigned()) {
    value = node_->get<std::uint64_t>();
  } else {
    // Whole doubles up to 2^53 are exact.
    const auto real = node_->get<double>();
    if (real != std::floor(real)) return refuse(ErrorCode::malformed, "must be a whole number");
    fits = real >= 0.0 && real <= 9007199254740992.0;
    if (fits) value = static_cast<std::uint64_t>(real);
  }
  if (fits && value >= least && value <= most) return value;
  return refuse(ErrorCode::out_of_range,
                "must be between " + std::to_string(least) + " and " + std::to_string(most) + ", not " + node_->dump());
}

bool JsonCursor::boolean() const {
  if (!node_->is_boolean()) return fail(ErrorCode::malformed, "must be true or false, not " + kind_of(*node_)), false;
  return node_->get<bool>();
}

std::string JsonCursor::text(std::size_t most_bytes) const {
  if (!node_->is_string()) return fail(ErrorCode::malformed, "must be a string, not " + kind_of(*node_)), std::string();
  const auto& value = node_->get_ref<const std::string&>();
  if (value.size() <= most_bytes) return value;
  fail(ErrorCode::too_large, "must not exceed " + std::to_string(most_bytes) + " bytes");
  return {};
}

bool JsonCursor::has(std::string_view name) const {
  const json* const found = find(name);
  return found != nullptr && !found->is_null();
}

std::uint64_t JsonCursor::integer_or(std::string_view name, std::uint64_t otherwise) const {
  return has(name) ? member(name).integer() : otherwise;
}

double JsonCursor::number_or(std::string_view name, double otherwise) const {
  return has(name) ? member(name).number() : otherwise;
}

bool JsonCursor::boolean_or(std::string_view name, bool otherwise) const {
  return has(name) ? member(name).boolean() : otherwise;
}

std::string JsonCursor::text_or(std::string_view name, const char* otherwise) const {
  return has(name) ? member(name).text() : std::string(otherwise);
}

std::size_t JsonCursor::size_of(std::string_view name) const { return has(name) ? member(name).size() : 0; }

std::optional<std::size_t> JsonCursor::index(std::string_view name, std::size_t count) const {
  if (!has(name)) return std::nullopt;
  const JsonCursor member = this->member(name);
  if (count == 0) return member.fail(ErrorCode::out_of_range, "refers to an empty list"), std::nullopt;
  const std::uint64_t value = member.integer(0, count - 1);
  return member.failed() ? std::nullopt : std::optional(static_cast<std::size_t>(value));
}

std::size_t JsonCursor::required_index(std::string_view name, std::size_t count) const {
  if (!has(name)) member(name).fail(ErrorCode::missing, "is missing");
  return index(name, count).value_or(0);
}

std::vector<std::string> JsonCursor::texts(std::string_view name, std::size_t most) const {
  std::vector<std::string> texts;
  const json* const found = find(name);
  if (found == nullptr || !found->is_array()) return texts;
  for (const json& item : *found) {
    if (texts.size() == most) break;
    texts.push_back(item.is_string() ? item.get<std::string>() : std::string());
  }
  return texts;
}

}  // namespace semblante
