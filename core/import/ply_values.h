#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/import/byte_reader.h"
#include "core/import/ply_header.h"
#include "core/import/text.h"
#include "core/types/result.h"

namespace semblante::import {

/// Sequential values of the text or of the binary data after a PLY header. The first error is kept; later values are
/// zero.
class PlyValues {
 public:
  PlyValues(std::span<const std::uint8_t> bytes, const PlyHeader& header);

  double next(PlyType type);
  /// The number of items of a list, checked against the unread bytes.
  Result<std::size_t> list_size(const PlyProperty& list);

  /// To be called after each element. In a text the line should end there; if it does not, misplaced() tells where.
  void end_element() {
    if (is_text_ && !misplaced_ && line_.find_first_not_of(" \t\r") != std::string_view::npos) misplaced_ = where();
  }
  /// The first line of a text in which an element ended before the line did.
  [[nodiscard]] const std::optional<std::string>& misplaced() const { return misplaced_; }

  /// A lower bound of the unread bytes; limits every declared count.
  [[nodiscard]] std::size_t left() const { return is_text_ ? line_.size() + 1 + lines_.rest().size() : data_.left(); }
  [[nodiscard]] const std::optional<Error>& fault() const { return fault_; }
  [[nodiscard]] std::string where() const;

 private:
  double next_of_bytes(PlyType type);
  double next_of_text();

  bool is_text_;
  std::size_t offset_;
  ByteReader data_;
  LineReader lines_;
  std::string_view line_;
  std::size_t header_lines_;
  std::optional<std::string> misplaced_;
  std::optional<Error> fault_;
};

}  // namespace semblante::import
