#include "server/store/last_database.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <string>

#include "server/store/descriptor.h"

namespace semblante::store {
namespace {

constexpr const char* file_name = "last-database";

}  // namespace

std::optional<DatabaseIdentity> read_last_database(const std::filesystem::path& data) {
  const Descriptor file(data / file_name, O_RDONLY);
  std::array<char, 256> bytes{};
  const auto got = file.ok() ? ::read(file.get(), bytes.data(), bytes.size()) : -1;
  if (got <= 0) return std::nullopt;
  const std::string_view text(bytes.data(), static_cast<std::size_t>(got));
  const auto space = text.find(' ');
  if (space == 0 || space == std::string_view::npos || !text.ends_with('\n')) return std::nullopt;
  DatabaseIdentity identity;
  identity.id = text.substr(0, space);
  const auto* last = text.data() + text.size() - 1;
  const auto [end, error] = std::from_chars(text.data() + space + 1, last, identity.starts);
  if (error != std::errc() || end != last) return std::nullopt;
  return identity;
}

Status write_last_database(const std::filesystem::path& data, const DatabaseIdentity& identity) {
  const auto target = data / file_name;
  const auto path = data / (std::string(file_name) + ".part");
  const auto text = identity.id + " " + std::to_string(identity.starts) + "\n";
  ::unlink(path.c_str());  // left by a process that was killed
  {
    const Descriptor file(path, O_WRONLY | O_CREAT | O_EXCL);
    if (!file.ok()) return io_error(path);
    const auto written = ::write(file.get(), text.data(), text.size());
    if (written != static_cast<ssize_t>(text.size()) || ::fsync(file.get()) != 0) {
      auto error = io_error(path);
      ::unlink(path.c_str());
      return error;
    }
  }
  if (::rename(path.c_str(), target.c_str()) != 0 || !sync_folder(data)) return io_error(target);
  return Unit{};
}

}  // namespace semblante::store
