#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/json/json_tree.h"
#include "core/types/result.h"

namespace semblante {

/// A position in a JSON document with its pointer. Each read checks type and range; the FIRST error is reported, and
/// later reads return default values, so that the caller's code follows the format and checks for an error once at the
/// end. The document must outlive the cursor.
class JsonCursor {
 public:
  using Report = std::optional<Error>;
  /// Larger than any size or index of a real file, and small enough to add several without overflow.
  static constexpr std::uint64_t max_size = std::uint64_t{1} << 40U;

  JsonCursor(const JsonView& node, std::string pointer, Report& report)
      : node_(node), pointer_(std::move(pointer)), report_(&report) {}
  JsonCursor(const JsonView& root, Report& report) : JsonCursor(root, {}, report) {}
  JsonCursor(const JsonTree& tree, Report& report) : JsonCursor(tree.root(), report) {}

  /// Reports an error at this position, unless an earlier one is reported.
  void fail(ErrorCode code, std::string message) const;
  void fail(ErrorCode code, const char* message) const;
  /// With the place of this value.
  void fail(Error error) const;
  [[nodiscard]] bool failed() const { return report_->has_value(); }
  [[nodiscard]] const std::string& pointer() const { return pointer_; }

  [[nodiscard]] bool is_null() const;
  [[nodiscard]] bool is_text() const;
  [[nodiscard]] bool is_array() const;
  [[nodiscard]] bool is_empty_array() const;
  void must_be_object() const;

  /// Reports `missing` when there is no such member; reads from the result then return default values.
  [[nodiscard]] JsonCursor member(std::string_view name) const;
  [[nodiscard]] std::optional<JsonCursor> optional_member(std::string_view name) const;
  /// Names and values of an object, sorted by name. The names are views into the document.
  [[nodiscard]] std::vector<std::pair<std::string_view, JsonCursor>> members() const;

  /// Size of the array; reports an error for any other type.
  [[nodiscard]] std::size_t size() const;
  /// An element of an array; `index` must be below size().
  [[nodiscard]] JsonCursor element(std::size_t index) const;
  /// All elements of the array; empty, with an error, when their number is not within `least` to `most`.
  [[nodiscard]] std::vector<JsonCursor> elements(std::size_t least, std::size_t most) const;

  [[nodiscard]] double number() const;
  [[nodiscard]] double number(double least, double most) const;
  /// An integer in any notation (4, 4.0, 4e0).
  [[nodiscard]] std::uint64_t integer(std::uint64_t least = 0, std::uint64_t most = max_size) const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string text(std::size_t most_bytes = std::string::npos) const;

  // For glTF: optional members with defaults, and members that are indices into arrays. A null member counts as
  // absent, because some exporters write null.
  [[nodiscard]] bool has(std::string_view name) const;
  [[nodiscard]] std::uint64_t integer_or(std::string_view name, std::uint64_t otherwise) const;  ///< up to max_size
  [[nodiscard]] double number_or(std::string_view name, double otherwise) const;
  [[nodiscard]] bool boolean_or(std::string_view name, bool otherwise) const;
  [[nodiscard]] std::string text_or(std::string_view name, const char* otherwise) const;
  /// Size of a member that is an array or absent.
  [[nodiscard]] std::size_t size_of(std::string_view name) const;
  /// An index into an array of `count`; nullopt when absent.
  [[nodiscard]] std::optional<std::size_t> index(std::string_view name, std::size_t count) const;
  /// Like index(), for a required member.
  [[nodiscard]] std::size_t required_index(std::string_view name, std::size_t count) const;
  /// For a member of any content ("extras"): the first `most` strings of an array, "" for elements of other types;
  /// empty for anything else.
  [[nodiscard]] std::vector<std::string> texts(std::string_view name, std::size_t most) const;

 private:
  [[nodiscard]] JsonView find(std::string_view name) const;
  [[nodiscard]] JsonCursor child(const JsonView& node, std::string_view name) const;
  /// Whether the value is of this kind; reports an error that asks for `what` if it is not.
  [[nodiscard]] bool must_be(bool is, const char* what) const;

  JsonView node_;
  std::string pointer_;
  Report* report_;
};

}  // namespace semblante
