#include "server/http/content_coding.h"

#include <cerrno>
#include <new>
#include <string>
#include <system_error>
#include <unistd.h>
#include <zlib.h>

#include "core/types/letter_case.h"
#include "server/http/media_type.h"

namespace semblante::http {
namespace {

std::string read_body(const FileBody& file) {
  std::string bytes(file.length, '\0');
  const auto open = file.open ? file.open : std::make_shared<const OpenFile>(file.path);
  std::uint64_t read = 0;
  while (read < file.length) {
    const auto count =
        ::pread(open->descriptor(), bytes.data() + read, file.length - read, static_cast<off_t>(file.offset + read));
    if (count <= 0) throw std::system_error(EIO, std::generic_category(), file.path.string());
    read += static_cast<std::uint64_t>(count);
  }
  return bytes;
}

std::string gzip(const std::string& bytes) {
  constexpr int gzip_window = 15 + 16;  // the largest window, in gzip's frame
  z_stream stream{};
  if (::deflateInit2(&stream, 6, Z_DEFLATED, gzip_window, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
  std::string packed(::deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  ::deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  ::deflateEnd(&stream);
  return packed;
}

}  // namespace

bool accepts_coding(std::string_view accept_encoding, std::string_view coding) {
  bool taken = false;
  for (const auto& item : split_list(accept_encoding)) {
    const auto name = essence(item);
    if (name != coding && name != "*") continue;
    const auto weight = parameter(item, "q");
    taken = weight.empty() || weight.find_first_of("123456789") != std::string::npos;
    if (name == coding) return taken;
  }
  return taken;
}

void vary_by(Response& response, std::string_view field) {
  auto& value = response.headers["Vary"];
  for (const auto& name : split_list(value))
    if (equal_ignoring_case(name, field)) return;
  value.append(value.empty() ? "" : ", ").append(field);
}

bool wants_coding(const Request& request, std::string_view coding) {
  return !request.header("Range") && accepts_coding(request.header("Accept-Encoding").value_or(""), coding);
}

void mark_coding(Response& response, std::string_view coding) {
  response.headers["Content-Encoding"] = std::string(coding);
  auto& etag = response.headers["ETag"];
  etag.insert(etag.size() - 1, "-" + std::string(coding));
}

void gzip_body(Response& response) {
  if (response.status != 200) return;
  if (const auto* file = std::get_if<FileBody>(&response.body))
    response.body = gzip(read_body(*file));
  else if (const auto* text = std::get_if<std::string>(&response.body))
    response.body = gzip(*text);
}

}  // namespace semblante::http
