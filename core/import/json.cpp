#include "core/import/json.h"

#include <cmath>
#include <set>
#include <vector>

#include "core/import/text.h"

namespace semblante::import {
namespace {

using nlohmann::json;

const json null_value;

/// Counts brackets and commas outside of strings: an upper bound of the tree the text can become.
Status check_shape(std::string_view text, const JsonLimits& limits) {
  std::size_t depth = 0;
  std::size_t values = 1;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') {
        ++i;
      } else if (c == '"') {
        in_string = false;
      }
      continue;
    }
    if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      ++values;
      if (++depth > limits.max_depth) {
        return Error{ErrorCode::too_large, "byte " + std::to_string(i),
                     "JSON nested deeper than " + std::to_string(limits.max_depth)};
      }
    } else if (c == ']' || c == '}') {
      if (depth > 0) --depth;
    } else if (c == ',' && ++values > limits.max_values) {
      return Error{ErrorCode::too_large, "byte " + std::to_string(i),
                   "JSON with more than " + std::to_string(limits.max_values) + " values"};
    }
  }
  return Unit{};
}

/// An object or array being parsed, kept to notice members named twice and to say where they are.
struct OpenValue {
  bool is_array = false;
  std::set<std::string> keys;
  std::string key;           ///< of the member being read; empty before the first
  std::size_t elements = 0;  ///< read so far
};

std::string pointer_to(const std::vector<OpenValue>& open) {
  std::string pointer;
  for (const OpenValue& value : open) {
    if (!value.is_array && value.keys.empty()) break;
    pointer.push_back('/');
    pointer.append(value.is_array ? std::to_string(value.elements) : pointer_segment(value.key));
  }
  return pointer;
}

std::string_view kind_of(const json& value) {
  switch (value.type()) {
    case json::value_t::object:
      return "an object";
    case json::value_t::array:
      return "an array";
    case json::value_t::string:
      return "a text";
    case json::value_t::boolean:
      return "true or false";
    case json::value_t::null:
      return "null";
    default:
      return "a number";
  }
}

}  // namespace

Result<json> parse_json(std::string_view text, const JsonLimits& limits) {
  if (Status status = check_shape(text, limits); !status) return status.error();
  std::vector<OpenValue> open;
  std::optional<Error> twice;
  const auto watch_keys = [&](int /*depth*/, json::parse_event_t event, json& parsed) {
    switch (event) {
      case json::parse_event_t::object_start:
        open.emplace_back();
        break;
      case json::parse_event_t::array_start:
        open.emplace_back().is_array = true;
        break;
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        open.pop_back();
        [[fallthrough]];
      case json::parse_event_t::value:
        if (!open.empty()) ++open.back().elements;
        break;
      case json::parse_event_t::key: {
        open.back().key = parsed.get<std::string>();
        const bool is_new = open.back().keys.insert(open.back().key).second;
        if (!is_new && !twice) twice = Error{ErrorCode::malformed, pointer_to(open), "is there twice"};
        break;
      }
    }
    return true;
  };
  try {
    json tree = json::parse(text.begin(), text.end(), watch_keys);
    if (twice) return *twice;
    return tree;
  } catch (const json::parse_error& fault) {
    const std::string byte = "byte " + std::to_string(fault.byte);
    const std::string pointer = pointer_to(open);
    return Error{ErrorCode::malformed, pointer.empty() ? byte : pointer, "is not valid JSON (" + byte + ")"};
  } catch (const json::exception&) {
    return Error{ErrorCode::out_of_range, pointer_to(open), "is a number that is too large"};
  }
}

std::string pointer_segment(std::string_view key) {
  std::string text;
  for (const char c : printable(key)) {
    if (c == '~') {
      text += "~0";
    } else if (c == '/') {
      text += "~1";
    } else {
      text += c;
    }
  }
  return text;
}

bool JsonCursor::has(const char* key) const {
  if (!value_->is_object()) return false;
  const auto member = value_->find(key);
  return member != value_->end() && !member->is_null();
}

JsonCursor JsonCursor::operator[](const char* key) const {
  JsonCursor member(&null_value, pointer_ + "/" + pointer_segment(key), fault_);
  if (has(key)) {
    member.value_ = &*value_->find(key);
  } else {
    member.fail(ErrorCode::missing, "is missing");
  }
  return member;
}

JsonCursor JsonCursor::element(std::size_t index) const {
  JsonCursor child(&null_value, pointer_ + "/" + std::to_string(index), fault_);
  if (index < size()) {
    child.value_ = &(*value_)[index];
  } else {
    child.fail(ErrorCode::missing, "is missing");
  }
  return child;
}

std::size_t JsonCursor::size() const {
  if (value_->is_array()) return value_->size();
  fail(ErrorCode::malformed, "must be an array, it is " + std::string(kind_of(*value_)));
  return 0;
}

std::uint64_t JsonCursor::integer(std::uint64_t max) const {
  if (value_->is_number_unsigned()) {
    const auto value = value_->get<std::uint64_t>();
    if (value <= max) return value;
    fail(ErrorCode::out_of_range, "is " + std::to_string(value) + ", at most " + std::to_string(max) + " is possible");
    return 0;
  }
  if (value_->is_number_integer()) {
    fail(ErrorCode::out_of_range, "must not be negative");
  } else if (value_->is_number()) {
    fail(ErrorCode::malformed, "must be a whole number");
  } else {
    fail(ErrorCode::malformed, "must be a whole number, it is " + std::string(kind_of(*value_)));
  }
  return 0;
}

double JsonCursor::number() const {
  if (!value_->is_number()) {
    fail(ErrorCode::malformed, "must be a number, it is " + std::string(kind_of(*value_)));
    return 0.0;
  }
  const auto value = value_->get<double>();
  if (std::isfinite(value)) return value;
  fail(ErrorCode::not_finite, "is not a finite number");
  return 0.0;
}

bool JsonCursor::boolean() const {
  if (value_->is_boolean()) return value_->get<bool>();
  fail(ErrorCode::malformed, "must be true or false, it is " + std::string(kind_of(*value_)));
  return false;
}

std::string JsonCursor::text() const {
  if (value_->is_string()) return value_->get<std::string>();
  fail(ErrorCode::malformed, "must be a text, it is " + std::string(kind_of(*value_)));
  return {};
}

void JsonCursor::must_be_object() const {
  if (!value_->is_object()) fail(ErrorCode::malformed, "must be an object, it is " + std::string(kind_of(*value_)));
}

std::uint64_t JsonCursor::integer_or(const char* key, std::uint64_t otherwise) const {
  return has(key) ? (*this)[key].integer() : otherwise;
}

double JsonCursor::number_or(const char* key, double otherwise) const {
  return has(key) ? (*this)[key].number() : otherwise;
}

bool JsonCursor::boolean_or(const char* key, bool otherwise) const {
  return has(key) ? (*this)[key].boolean() : otherwise;
}

std::string JsonCursor::text_or(const char* key, const char* otherwise) const {
  return has(key) ? (*this)[key].text() : std::string(otherwise);
}

std::optional<std::size_t> JsonCursor::index(const char* key, std::size_t count) const {
  if (!has(key)) return std::nullopt;
  const JsonCursor member = (*this)[key];
  const std::uint64_t value = member.integer(~std::uint64_t{0});
  if (value < count) return static_cast<std::size_t>(value);
  member.fail(ErrorCode::out_of_range, "is " + std::to_string(value) + ", there are " + std::to_string(count));
  return std::nullopt;
}

std::size_t JsonCursor::required_index(const char* key, std::size_t count) const {
  if (!has(key)) (*this)[key].fail(ErrorCode::missing, "is missing");
  return index(key, count).value_or(0);
}

std::size_t JsonCursor::size_of(const char* key) const { return has(key) ? (*this)[key].size() : 0; }

std::vector<std::string> JsonCursor::texts(const char* key, std::size_t most) const {
  std::vector<std::string> texts;
  if (!has(key) || !(*value_)[key].is_array()) return texts;
  for (const json& item : (*value_)[key]) {
    if (texts.size() == most) break;
    texts.push_back(item.is_string() ? item.get<std::string>() : std::string());
  }
  return texts;
}

void JsonCursor::fail(ErrorCode code, std::string message) const {
  if (!*fault_) *fault_ = Error{code, pointer_, std::move(message)};
}

}  // namespace semblante::import
