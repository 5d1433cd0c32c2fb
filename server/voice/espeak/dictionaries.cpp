#include "server/voice/espeak/dictionaries.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <map>
#include <string>
#include <string_view>
#include <unistd.h>

#include <sys/mman.h>
#include <sys/stat.h>

namespace semblante::voice {
namespace {

struct Mapped {
  void* bytes = nullptr;
  struct stat facts {};
};

/// By their paths, as the library builds them: the folder, '/', and the name.
std::map<std::string, Mapped, std::less<>>& kept() {
  static std::map<std::string, Mapped, std::less<>> files;
  return files;
}

void keep(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  Mapped mapped;
  if (::fstat(file, &mapped.facts) == 0 && mapped.facts.st_size > 0) {
    mapped.bytes = ::mmap(nullptr, static_cast<std::size_t>(mapped.facts.st_size), PROT_READ, MAP_PRIVATE, file, 0);
    if (mapped.bytes != MAP_FAILED) kept().emplace(path, mapped);
  }
  ::close(file);
}

const Mapped* find(const char* path) {
  const auto at = kept().find(std::string_view(path));
  return at == kept().end() ? nullptr : &at->second;
}

}  // namespace

void keep_dictionaries(const std::filesystem::path& data) {
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(data, ignored))
    if (entry.path().filename().string().ends_with("_dict"))
      keep(data.string() + '/' + entry.path().filename().string());
}

}  // namespace semblante::voice

// The names of the C library, seen by the libraries that are linked dynamically.
extern "C" {

__attribute__((visibility("default"))) std::FILE* fopen(const char* path, const char* mode) {
  if (const auto* const file = semblante::voice::find(path))
    return ::fmemopen(file->bytes, static_cast<std::size_t>(file->facts.st_size), "r");
  return ::fopen64(path, mode);
}

__attribute__((visibility("default"))) int stat(const char* path, struct stat* facts) {
  if (const auto* const file = semblante::voice::find(path)) {
    *facts = file->facts;
    return 0;
  }
  return ::fstatat(AT_FDCWD, path, facts, 0);
}
}
