#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/json/json_view.h"
#include "core/types/result.h"

namespace semblante {

/// Limits of one JSON text. A document uses at most 256 bytes of memory per value, plus the bytes of its strings.
/// Values are scalars, arrays and objects, each counted once; member names are not counted.
struct JsonLimits {
  std::size_t max_bytes = std::numeric_limits<std::size_t>::max();
  std::size_t max_depth = 64;
  std::size_t max_values = 4'000'000;
};

/// A JSON document in three blocks of memory.
class JsonTree final : public JsonHolder {
 public:
  [[nodiscard]] JsonView root() const { return {*this, &root_}; }

  [[nodiscard]] JsonKind kind(const void* node) const override;
  [[nodiscard]] std::size_t size(const void* node) const override;
  [[nodiscard]] const void* element(const void* node, std::size_t index) const override;
  [[nodiscard]] const void* member(const void* node, std::string_view name) const override;
  void members(const void* node, void* context, Visit visit) const override;
  [[nodiscard]] double number(const void* node) const override;
  [[nodiscard]] std::uint64_t natural(const void* node) const override;
  [[nodiscard]] std::int64_t negative(const void* node) const override;
  [[nodiscard]] std::string_view text(const void* node) const override;

 private:
  friend class JsonReader;

  /// A value. Offset and length of its name and of its text are in `texts_`; the children of a container are
  /// consecutive in `nodes_`, those of an object in the order of their names.
  struct Node {
    JsonKind kind = JsonKind::null;
    std::uint32_t name = 0;
    std::uint32_t name_size = 0;
    union {
      std::uint64_t bits = 0;  ///< natural, negative, boolean
      double real;
      struct {
        std::uint32_t begin;
        std::uint32_t count;
      } range;  ///< text, array, object
    };
  };

  [[nodiscard]] std::string_view name_of(const Node& node) const;

  Node root_;
  std::vector<Node> nodes_;
  std::string texts_;
};

/// A member array of the outermost object whose elements are passed one by one to `take` and not kept, for documents
/// too large for memory. The array is empty in the resulting document.
struct JsonElements {
  std::string_view member;
  /// Called with each element and its index; an error ends the reading and becomes its result.
  std::function<Status(std::size_t index, const JsonView& element)> take;
};

/// Parses a text. Errors have the JSON pointer in `where` (empty for invalid JSON: the message then has the byte
/// offset): `malformed` for invalid JSON and duplicate members, `not_finite` for a number beyond the range of a double,
/// `too_large` for exceeded limits. Pointers are printable and at most 1000 bytes long.
Result<JsonTree> read_json_tree(std::string_view text, const JsonLimits& limits = {});

/// Like read_json_tree(), for a text that must be an object. `elements` may be null; `limits.max_values` then bounds
/// the values in memory at a time: those of the document so far and of one element.
Result<JsonTree> read_json_object_tree(std::string_view text, const JsonLimits& limits = {},
                                       const JsonElements* elements = nullptr);

}  // namespace semblante
