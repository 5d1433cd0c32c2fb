#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/import/gltf_container.h"
#include "core/import/limits.h"
#include "core/import/resource_reader.h"
#include "core/json/json_cursor.h"

namespace semblante::import {

/// A glTF's JSON and its buffers. All returned data is checked against the available bytes; the first error is kept
/// (see JsonCursor), and later calls return empty values.
class GltfDocument {
 public:
  GltfDocument(JsonTree tree, std::span<const std::uint8_t> binary, ResourceReader resources,
               const ImportLimits& limits)
      : tree_(std::move(tree)), binary_(binary), resources_(std::move(resources)), limits_(limits) {}
  GltfDocument(const GltfDocument&) = delete;
  GltfDocument& operator=(const GltfDocument&) = delete;

  [[nodiscard]] JsonCursor root() { return {tree_, fault_}; }
  /// The same, with its faults in `report`: for members that may be wrong without harm.
  [[nodiscard]] JsonCursor root(JsonCursor::Report& report) { return {tree_, report}; }
  [[nodiscard]] bool failed() const { return fault_.has_value(); }
  [[nodiscard]] const Error& fault() const { return *fault_; }
  [[nodiscard]] std::size_t count(const char* array) { return root().size_of(array); }

  /// Element `index` of a top-level array; an error if it does not exist.
  [[nodiscard]] JsonCursor item(const char* array, std::size_t index) { return root().member(array).element(index); }

  /// The bytes of a buffer view, decoded if compressed with EXT_meshopt_compression.
  std::span<const std::uint8_t> view(std::size_t index);
  /// The bytes of a buffer view for Draco decoding. A file may use one view many times; in total at most eight times
  /// its bytes are decoded, else the error too_large is reported at `where`.
  std::span<const std::uint8_t> draco_view(std::size_t index, const JsonCursor& where);
  /// The bytes of a "uri" member: a data: URI, or another file of the model.
  Result<std::vector<std::uint8_t>> resource(const std::string& uri);

  /// Declared number of elements of an accessor, at most `max`.
  std::size_t accessor_count(std::size_t accessor, std::size_t max);
  /// `count` rows of `components` floats, with normalized integers converted and sparse values applied. `components`
  /// must match the accessor's type. Reports the error `mismatch` if the accessor has another count. A row with a value
  /// that is not finite is an error, or zero.
  enum class NotFinite : std::uint8_t { refused, zero };
  std::vector<float> floats(std::size_t accessor, std::size_t components, std::size_t count,
                            NotFinite not_finite = NotFinite::refused);
  /// The nonzero rows of a VEC3 accessor of `count` elements, in increasing order: a sparse accessor costs its listed
  /// rows, not its declared count. Each examined row decrements `budget`; if the budget is too small, it is set to 0
  /// and nothing is read.
  struct Row {
    std::uint32_t index = 0;
    std::array<float, 3> value{};
  };
  std::vector<Row> rows(std::size_t accessor, std::size_t count, std::size_t& budget);
  /// Unsigned scalars, each below `end`; at most `max_count`.
  std::vector<std::uint32_t> indices(std::size_t accessor, std::size_t end, std::size_t max_count);

 private:
  /// The layout of elements: `stride` bytes apart, each inside `bytes`.
  struct Layout {
    std::span<const std::uint8_t> bytes;
    std::size_t stride = 0;
  };

  /// The elements of an accessor; `layout` is empty without a buffer view, which means all zeros.
  struct Elements {
    std::uint64_t type = 0;
    bool normalized = false;
    bool has_view = false;
    std::size_t components = 0;
    std::size_t size = 0;  ///< bytes of one
    Layout layout;
  };

  std::span<const std::uint8_t> buffer(std::size_t index);
  /// The bytes given by "buffer", "byteOffset" and "byteLength" of an object.
  std::span<const std::uint8_t> slice(const JsonCursor& where);
  Elements elements(const JsonCursor& where, std::size_t components, std::size_t count);
  static bool read_row(const JsonCursor& where, const Elements& elements, std::size_t row, const std::uint8_t* from,
                       float* to, NotFinite not_finite = NotFinite::refused);
  Layout layout(const JsonCursor& where, std::size_t count, std::size_t element_size);
  template <class Put>
  void for_each_sparse(const JsonCursor& accessor, std::size_t count, std::size_t element_size, Put put);

  JsonTree tree_;
  std::span<const std::uint8_t> binary_;
  ResourceReader resources_;
  ImportLimits limits_;
  std::optional<Error> fault_;
  std::size_t draco_bytes_ = 0;                                   ///< decoded so far
  std::size_t resource_bytes_ = 0;                                ///< decoded so far, bounded by limits_.max_file_bytes
  std::vector<std::optional<std::vector<std::uint8_t>>> loaded_;  ///< by buffer
  std::vector<std::optional<std::vector<std::uint8_t>>> decoded_views_;  ///< by buffer view
};

}  // namespace semblante::import
