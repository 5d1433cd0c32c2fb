#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/types/result.h"

namespace semblante::import {

struct JsonLimits {
  std::size_t max_depth = 64;
  std::size_t max_values = 4'000'000;
};

/// A JSON text as a tree. Its shape is counted before any of it is built; a member named twice is an error, since one
/// of the two would be lost without a word. Errors name the member they are at, or the byte where there is none.
Result<nlohmann::json> parse_json(std::string_view text, const JsonLimits& limits = {});

/// A place in a JSON tree that knows its own pointer. Reading something that is not there, or of the wrong kind, keeps
/// the first such fault and gives an empty value, so that a reader runs straight and asks once in the end.
class JsonCursor {
 public:
  JsonCursor(const nlohmann::json& root, std::optional<Error>& fault) : value_(&root), fault_(&fault) {}

  [[nodiscard]] const std::string& pointer() const { return pointer_; }
  [[nodiscard]] bool has(const char* key) const;
  /// A member that must be there.
  JsonCursor operator[](const char* key) const;
  /// An element of an array; `index` must be below size().
  [[nodiscard]] JsonCursor element(std::size_t index) const;
  /// Of the array this must be.
  [[nodiscard]] std::size_t size() const;

  [[nodiscard]] std::uint64_t integer(std::uint64_t max = std::uint64_t{1} << 40) const;
  [[nodiscard]] double number() const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string text() const;
  void must_be_object() const;

  /// An index into an array of `count` that must be there.
  [[nodiscard]] std::size_t required_index(const char* key, std::size_t count) const;

  // A member that may be absent.
  [[nodiscard]] std::uint64_t integer_or(const char* key, std::uint64_t otherwise) const;
  [[nodiscard]] double number_or(const char* key, double otherwise) const;
  [[nodiscard]] bool boolean_or(const char* key, bool otherwise) const;
  [[nodiscard]] std::string text_or(const char* key, const char* otherwise) const;
  /// An index into an array of `count`; nullopt when absent.
  [[nodiscard]] std::optional<std::size_t> index(const char* key, std::size_t count) const;
  /// Size of a member that is an array or absent.
  [[nodiscard]] std::size_t size_of(const char* key) const;
  /// Of a member that follows no rules ("extras"): the first texts of an array, `most` of them, "" for what is none;
  /// empty for anything else.
  [[nodiscard]] std::vector<std::string> texts(const char* key, std::size_t most) const;

  /// Keeps this fault at this place, unless there is one already.
  void fail(ErrorCode code, std::string message) const;

 private:
  JsonCursor(const nlohmann::json* value, std::string pointer, std::optional<Error>* fault)
      : value_(value), pointer_(std::move(pointer)), fault_(fault) {}

  const nlohmann::json* value_;
  std::string pointer_;
  std::optional<Error>* fault_;
};

/// A key as a segment of a JSON pointer: "~" and "/" escaped (RFC 6901).
std::string pointer_segment(std::string_view key);

}  // namespace semblante::import
