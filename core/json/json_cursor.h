#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/types/result.h"

namespace semblante {

/// A place in a JSON document that knows its pointer. Reads by the caller's expectations; the FIRST thing that is not
/// as expected goes into the report, and reading goes on with harmless values, so that code reads like the format and
/// asks once in the end. The document must outlive the cursor.
class JsonCursor {
 public:
  using Report = std::optional<Error>;
  /// Above any size or index of a real file, and small enough to add a few of.
  static constexpr std::uint64_t max_size = std::uint64_t{1} << 40U;

  JsonCursor(const nlohmann::json& root, Report& report) : JsonCursor(root, {}, report) {}
  JsonCursor(const nlohmann::json& node, std::string pointer, Report& report)
      : node_(&node), pointer_(std::move(pointer)), report_(&report) {}

  /// Reports this at this place, unless something is reported already.
  void fail(ErrorCode code, std::string message) const;
  [[nodiscard]] bool failed() const { return report_->has_value(); }
  [[nodiscard]] const std::string& pointer() const { return pointer_; }

  [[nodiscard]] bool is_null() const;
  [[nodiscard]] bool is_text() const;
  [[nodiscard]] bool is_array() const;
  [[nodiscard]] bool is_empty_array() const;
  void must_be_object() const;

  /// Reports `missing` when there is no such member; what is read from it then is harmless.
  [[nodiscard]] JsonCursor member(std::string_view name) const;
  [[nodiscard]] std::optional<JsonCursor> optional_member(std::string_view name) const;
  /// Names and values of an object, by name. The names are those in the document.
  [[nodiscard]] std::vector<std::pair<std::string_view, JsonCursor>> members() const;

  /// Of the array this must be.
  [[nodiscard]] std::size_t size() const;
  /// An element of an array; `index` must be below size().
  [[nodiscard]] JsonCursor element(std::size_t index) const;
  /// All elements of the array this must be; none when there are fewer or more than these.
  [[nodiscard]] std::vector<JsonCursor> elements(std::size_t least, std::size_t most) const;

  [[nodiscard]] double number() const;
  [[nodiscard]] double number(double least, double most) const;
  /// A whole number, however it is written (4, 4.0, 4e0).
  [[nodiscard]] std::uint64_t integer(std::uint64_t least = 0, std::uint64_t most = max_size) const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string text(std::size_t most_bytes = std::string::npos) const;

  // glTF's habit: members that have a default, or name an element of an array by its index. A member that is null
  // counts as absent, since some exporters write those.
  [[nodiscard]] bool has(std::string_view name) const;
  [[nodiscard]] std::uint64_t integer_or(std::string_view name, std::uint64_t otherwise) const;  ///< up to max_size
  [[nodiscard]] double number_or(std::string_view name, double otherwise) const;
  [[nodiscard]] bool boolean_or(std::string_view name, bool otherwise) const;
  [[nodiscard]] std::string text_or(std::string_view name, const char* otherwise) const;
  /// Size of a member that is an array or absent.
  [[nodiscard]] std::size_t size_of(std::string_view name) const;
  /// An index into an array of `count`; nullopt when absent.
  [[nodiscard]] std::optional<std::size_t> index(std::string_view name, std::size_t count) const;
  /// The same, of a member that must be there.
  [[nodiscard]] std::size_t required_index(std::string_view name, std::size_t count) const;
  /// Of a member that follows no rules ("extras"): the first texts of an array, `most` of them, "" for what is none;
  /// empty for anything else.
  [[nodiscard]] std::vector<std::string> texts(std::string_view name, std::size_t most) const;

 private:
  [[nodiscard]] const nlohmann::json* find(std::string_view name) const;
  [[nodiscard]] JsonCursor child(const nlohmann::json* node, std::string_view name) const;

  const nlohmann::json* node_;
  std::string pointer_;
  Report* report_;
};

}  // namespace semblante
