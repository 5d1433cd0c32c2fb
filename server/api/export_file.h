#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <ostream>
#include <streambuf>
#include <vector>

#include "server/http/message.h"

namespace semblante::api {

/// A temporary file that an export is written to, which leaves free as many bytes of the disk as recordings do.
class ExportFile : private std::streambuf {
 public:
  /// `reserve`: bytes that stay free on the disk of `folder`. Throws StoreError.
  ExportFile(const std::filesystem::path& folder, std::uint64_t reserve);
  ~ExportFile() override;
  ExportFile(const ExportFile&) = delete;
  ExportFile& operator=(const ExportFile&) = delete;

  /// Fails when the disk is full; finish() then throws.
  [[nodiscard]] std::ostream& stream() { return stream_; }
  /// The whole file as a body; it is removed when the body is. Throws DiskFull or StoreError if a write failed.
  http::FileBody finish();
  /// Throws like finish() if a write failed already.
  void check() const;

 private:
  int_type overflow(int_type byte) override;
  int sync() override;
  bool write_buffer();

  static constexpr std::size_t buffer_bytes = std::size_t{1} << 20U;
  std::shared_ptr<http::TemporaryFile> file_;
  const std::filesystem::path folder_;
  const std::uint64_t reserve_;
  int descriptor_ = -1;
  int error_ = 0;  ///< errno of the write that failed
  bool is_disk_full_ = false;
  std::uint64_t written_ = 0;
  std::vector<char> buffer_;
  std::ostream stream_;
};

}  // namespace semblante::api
