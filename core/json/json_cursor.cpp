#include "core/json/json_cursor.h"

#include <algorithm>
#include <cmath>

#include "core/json/json_pointer.h"
#include "core/types/decimal.h"

namespace semblante {
namespace {

std::string text_of(const JsonView& number) {
  if (number.kind() == JsonKind::natural) return natural_text(number.natural());
  if (number.kind() == JsonKind::negative) return whole_text(number.negative());
  return shortest_text(number.number());
}

std::string not_between(const std::string& least, const std::string& most) {
  return "must be between " + least + " and " + most;
}

}  // namespace

void JsonCursor::fail(ErrorCode code, std::string message) const {
  if (!failed()) *report_ = Error{code, pointer_, std::move(message)};
}

void JsonCursor::fail(ErrorCode code, const char* message) const { fail(code, std::string(message)); }

void JsonCursor::fail(Error error) const {
  if (failed()) return;
  error.where = pointer_;
  *report_ = std::move(error);
}

bool JsonCursor::is_null() const { return node_.kind() == JsonKind::null; }
bool JsonCursor::is_text() const { return node_.kind() == JsonKind::text; }
bool JsonCursor::is_array() const { return node_.kind() == JsonKind::array; }
bool JsonCursor::is_empty_array() const { return is_array() && node_.size() == 0; }

bool JsonCursor::must_be(bool is, const char* what) const {
  if (!is) fail(ErrorCode::malformed, std::string("must be ") + what + ", not " + kind_name(node_.kind()));
  return is;
}

void JsonCursor::must_be_object() const { (void)must_be(node_.kind() == JsonKind::object, "an object"); }

JsonCursor JsonCursor::child(const JsonView& node, std::string_view name) const {
  std::string pointer = pointer_;
  append_to_pointer(pointer, name);
  return {node.has_value() ? node : JsonView(), std::move(pointer), *report_};
}

JsonView JsonCursor::find(std::string_view name) const {
  return node_.kind() == JsonKind::object ? node_.member(name) : JsonView();
}

JsonCursor JsonCursor::member(std::string_view name) const {
  must_be_object();
  const JsonView found = find(name);
  JsonCursor member = child(found, name);
  if (!found.has_value()) member.fail(ErrorCode::missing, "is missing");
  return member;
}

std::optional<JsonCursor> JsonCursor::optional_member(std::string_view name) const {
  must_be_object();
  const JsonView found = find(name);
  return found.has_value() ? std::optional(child(found, name)) : std::nullopt;
}

std::vector<std::pair<std::string_view, JsonCursor>> JsonCursor::members() const {
  std::vector<std::pair<std::string_view, JsonCursor>> members;
  must_be_object();
  if (node_.kind() != JsonKind::object) return members;
  node_.members([&](std::string_view name, const JsonView& value) { members.emplace_back(name, child(value, name)); });
  return members;
}

std::size_t JsonCursor::size() const { return must_be(is_array(), "an array") ? node_.size() : 0; }

JsonCursor JsonCursor::element(std::size_t index) const {
  std::string pointer = pointer_;
  append_to_pointer(pointer, index);
  const bool is_there = index < size();
  JsonCursor element(is_there ? node_.element(index) : JsonView(), std::move(pointer), *report_);
  if (!is_there) element.fail(ErrorCode::missing, "is missing");
  return element;
}

std::vector<JsonCursor> JsonCursor::elements(std::size_t least, std::size_t most) const {
  std::vector<JsonCursor> elements;
  const std::size_t count = size();
  if (!is_array()) return elements;
  if (count < least || count > most) {
    const std::string bounds = least == most ? natural_text(least) : natural_text(least) + " to " + natural_text(most);
    fail(count > most ? ErrorCode::too_large : ErrorCode::out_of_range,
         "must have " + bounds + " elements, not " + natural_text(count));
    return elements;
  }
  elements.reserve(count);
  for (std::size_t i = 0; i < count; ++i) elements.push_back(element(i));
  return elements;
}

double JsonCursor::number() const {
  if (!must_be(node_.is_number(), "a number")) return 0.0;
  const double value = node_.number();
  if (!std::isfinite(value)) return fail(ErrorCode::not_finite, "must be finite"), 0.0;
  return value;
}

double JsonCursor::number(double least, double most) const {
  const double value = number();
  if (value >= least && value <= most) return value;
  fail(ErrorCode::out_of_range, not_between(shortest_text(least), shortest_text(most)));
  return least;
}

std::uint64_t JsonCursor::integer(std::uint64_t least, std::uint64_t most) const {
  if (!must_be(node_.is_number(), "a whole number")) return least;
  std::uint64_t value = 0;
  bool fits = true;
  if (node_.kind() == JsonKind::natural) {
    value = node_.natural();
  } else {
    // Whole doubles up to 2^53 are exact.
    const double real = node_.number();
    if (real != std::floor(real)) return fail(ErrorCode::malformed, "must be a whole number"), least;
    fits = real >= 0.0 && real <= 9007199254740992.0;
    if (fits) value = static_cast<std::uint64_t>(real);
  }
  if (fits && value >= least && value <= most) return value;
  fail(ErrorCode::out_of_range, not_between(natural_text(least), natural_text(most)) + ", not " + text_of(node_));
  return least;
}

bool JsonCursor::boolean() const {
  return must_be(node_.kind() == JsonKind::boolean, "true or false") && node_.natural() != 0;
}

std::string JsonCursor::text(std::size_t most_bytes) const {
  if (!must_be(is_text(), "a string")) return {};
  const std::string_view value = node_.text();
  if (value.size() <= most_bytes) return std::string(value);
  fail(ErrorCode::too_large, "must not exceed " + natural_text(most_bytes) + " bytes");
  return {};
}

bool JsonCursor::has(std::string_view name) const {
  const JsonView found = find(name);
  return found.has_value() && found.kind() != JsonKind::null;
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
  const JsonView found = find(name);
  if (!found.has_value() || found.kind() != JsonKind::array) return texts;
  for (std::size_t i = 0; i < std::min(found.size(), most); ++i) {
    const JsonView item = found.element(i);
    texts.emplace_back(item.kind() == JsonKind::text ? item.text() : std::string_view());
  }
  return texts;
}

}  // namespace semblante
