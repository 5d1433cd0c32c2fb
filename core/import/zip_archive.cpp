#include "core/import/zip_archive.h"

#include <algorithm>
#include <zip.h>

#include "core/import/text.h"
#include "core/types/printable.h"

namespace semblante::import {
namespace {

constexpr std::size_t max_entries = 4096;

std::size_t count_of(std::string_view text, std::string_view what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + what.size())) ++count;
  return count;
}

struct CloseFile {
  void operator()(zip_file_t* file) const { zip_fclose(file); }
};

}  // namespace

void ZipArchive::Close::operator()(zip* archive) const { zip_discard(archive); }

Result<ZipArchive> ZipArchive::open(std::span<const std::uint8_t> bytes, std::size_t max_total_bytes) {
  // Each entry has one of these in the directory; libzip would allocate about 200 bytes for each.
  if (count_of(as_text(bytes), "PK\x01\x02") > max_entries) {
    return Error{ErrorCode::too_large, "", "the zip has more than " + std::to_string(max_entries) + " entries"};
  }
  zip_error_t fault;
  zip_error_init(&fault);
  zip_source_t* const source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &fault);
  zip_t* const archive = source == nullptr ? nullptr : zip_open_from_source(source, ZIP_RDONLY, &fault);
  if (archive == nullptr) {
    const std::string reason = zip_error_strerror(&fault);
    zip_error_fini(&fault);
    if (source != nullptr) zip_source_free(source);
    return Error{ErrorCode::malformed, "", "the zip cannot be read: " + printable(reason)};
  }
  zip_error_fini(&fault);
  return ZipArchive(archive, max_total_bytes);
}

ZipArchive::ZipArchive(zip* archive, std::size_t max_total_bytes)
    : archive_(archive), max_total_bytes_(max_total_bytes), left_(max_total_bytes) {
  const zip_int64_t count = zip_get_num_entries(archive, 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    const char* const name = zip_get_name(archive, static_cast<zip_uint64_t>(i), ZIP_FL_ENC_GUESS);
    if (name == nullptr || *name == '\0') continue;
    std::string path(name);
    // The format has slashes, but some programs of Windows write its own.
    std::replace(path.begin(), path.end(), '\\', '/');
    if (path.back() == '/') continue;
    if (entries_.try_emplace(path, static_cast<std::uint64_t>(i)).second) names_.push_back(std::move(path));
  }
}

Result<std::vector<std::uint8_t>> ZipArchive::read(const std::string& name, std::size_t max_bytes) {
  const auto found = entries_.find(name);
  if (found == entries_.end())
    return Error{ErrorCode::missing, "", "the zip has no entry " + shown(name), Advice::send_all_files};
  const std::uint64_t index = found->second;
  const auto too_large = [&] {
    return Error{
        ErrorCode::too_large, "",
        max_bytes <= left_
            ? "the zip's entry " + shown(name) + " inflates to more than " + std::to_string(max_bytes) + " bytes"
            : "the zip's files inflate to more than " + std::to_string(max_total_bytes_) + " bytes together"};
  };
  const std::size_t limit = std::min(max_bytes, left_);
  // An honest size saves the work; a smaller one than the true one is not trusted.
  zip_stat_t facts;
  zip_stat_init(&facts);
  if (zip_stat_index(archive_.get(), index, 0, &facts) == 0 && (facts.valid & ZIP_STAT_SIZE) != 0 && facts.size > limit)
    return too_large();
  const std::unique_ptr<zip_file_t, CloseFile> file(zip_fopen_index(archive_.get(), index, 0));
  if (file == nullptr) {
    return Error{ErrorCode::unsupported, "",
                 "the zip's entry " + shown(name) + " cannot be opened: " + printable(zip_strerror(archive_.get()))};
  }
  // The buffer grows with the inflated data.
  std::vector<std::uint8_t> bytes;
  constexpr std::size_t step = std::size_t{1} << 16;
  while (true) {
    const std::size_t size = bytes.size();
    if (size > limit) {
      const Error error = too_large();
      left_ -= limit;
      return error;
    }
    bytes.resize(size + step);
    const zip_int64_t got = zip_fread(file.get(), bytes.data() + size, step);
    if (got <= 0) left_ -= size;
    if (got < 0) return Error{ErrorCode::malformed, "", "the zip's entry " + shown(name) + " is damaged"};
    bytes.resize(size + static_cast<std::size_t>(got));
    if (got == 0) return bytes;
  }
}

}  // namespace semblante::import
