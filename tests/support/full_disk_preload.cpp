// Loaded before libc by LD_PRELOAD: below one folder the disk is full while a flag file exists. See full_disk.h.
#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <fcntl.h>
#include <string>
#include <unistd.h>

#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>

namespace {

const char* setting(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::string link_of(int descriptor) {
  std::array<char, 4096> target{};
  const auto link = "/proc/self/fd/" + std::to_string(descriptor);
  const auto size = ::readlink(link.c_str(), target.data(), target.size());
  return size > 0 ? std::string(target.data(), static_cast<std::size_t>(size)) : std::string();
}

std::string path_at(int folder, const char* path) {
  if (path == nullptr) return {};
  if (path[0] == '/') return path;
  const auto base = folder == AT_FDCWD ? std::string(".") : link_of(folder);
  return base + "/" + path;
}

/// The first byte of the flag's file, which every process maps: an isolated worker may not look at files.
volatile char* const flag = [] {
  static volatile char never = '0';
  const int file =
      static_cast<int>(::syscall(SYS_openat, AT_FDCWD, setting("SEMBLANTE_FULL_DISK_FLAG"), O_RDWR | O_CLOEXEC));
  void* const mapped = ::mmap(nullptr, 1, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (file >= 0) ::close(file);
  return mapped == MAP_FAILED ? &never : static_cast<volatile char*>(mapped);
}();

bool is_full() { return flag != nullptr && *flag == '1'; }

bool refuses(const std::string& path) {
  const std::string folder = std::string(setting("SEMBLANTE_FULL_DISK_FOLDER")) + "/";
  return folder.size() > 1 && path.compare(0, folder.size(), folder) == 0 && is_full();
}

bool refuses(int descriptor) {
  const int kept = errno;
  const bool refused = is_full() && refuses(link_of(descriptor));
  errno = refused ? ENOSPC : kept;
  return refused;
}

bool refuses_new(const std::string& path) {
  const int kept = errno;
  const bool refused = refuses(path) && ::access(path.c_str(), F_OK) != 0;
  errno = refused ? ENOSPC : kept;
  return refused;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

int open_with(const char* name, const char* path, int flags, mode_t mode) {
  if ((flags & O_CREAT) != 0 && refuses_new(path_at(AT_FDCWD, path))) return -1;
  return next<int (*)(const char*, int, ...)>(name)(path, flags, mode);
}

int open_at(const char* name, int folder, const char* path, int flags, mode_t mode) {
  if ((flags & O_CREAT) != 0 && refuses_new(path_at(folder, path))) return -1;
  return next<int (*)(int, const char*, int, ...)>(name)(folder, path, flags, mode);
}

std::FILE* fopen_with(const char* name, const char* path, const char* mode) {
  if (std::strpbrk(mode, "wa") != nullptr && refuses_new(path_at(AT_FDCWD, path))) return nullptr;
  return next<std::FILE* (*)(const char*, const char*)>(name)(path, mode);
}

template <class Offset>
int truncate_with(const char* name, int descriptor, Offset length) {
  struct stat facts {};
  if (::fstat(descriptor, &facts) == 0 && length > facts.st_size && refuses(descriptor)) return -1;
  return next<int (*)(int, Offset)>(name)(descriptor, length);
}

/// After a call that removed or renamed `path`: fills the disk if that is what was waited for.
void removed(const std::string& path) {
  const int kept = errno;
  const char* trigger = setting("SEMBLANTE_FULL_DISK_TRIGGER");
  const int file = next<int (*)(const char*, int, ...)>("open")(trigger, O_RDONLY | O_CLOEXEC);
  if (file >= 0) {
    std::array<char, 256> part{};
    const auto size = ::read(file, part.data(), part.size() - 1);
    ::close(file);
    if (size > 0 && path.find(part.data()) != std::string::npos) {
      next<int (*)(const char*)>("unlink")(trigger);
      *flag = '1';
    }
  }
  errno = kept;
}

}  // namespace

#define SEMBLANTE_MODE(last)                     \
  va_list arguments;                             \
  va_start(arguments, last);                     \
  const mode_t mode = va_arg(arguments, mode_t); \
  va_end(arguments)

extern "C" {

int open(const char* path, int flags, ...) {
  SEMBLANTE_MODE(flags);
  return open_with("open", path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  SEMBLANTE_MODE(flags);
  return open_with("open64", path, flags, mode);
}
int openat(int folder, const char* path, int flags, ...) {
  SEMBLANTE_MODE(flags);
  return open_at("openat", folder, path, flags, mode);
}
int openat64(int folder, const char* path, int flags, ...) {
  SEMBLANTE_MODE(flags);
  return open_at("openat64", folder, path, flags, mode);
}
std::FILE* fopen(const char* path, const char* mode) { return fopen_with("fopen", path, mode); }
std::FILE* fopen64(const char* path, const char* mode) { return fopen_with("fopen64", path, mode); }

ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  if (refuses(descriptor)) return -1;
  return next<ssize_t (*)(int, const void*, std::size_t)>("write")(descriptor, bytes, size);
}
ssize_t writev(int descriptor, const iovec* parts, int count) {
  if (refuses(descriptor)) return -1;
  return next<ssize_t (*)(int, const iovec*, int)>("writev")(descriptor, parts, count);
}
ssize_t pwrite(int descriptor, const void* bytes, std::size_t size, off_t offset) {
  if (refuses(descriptor)) return -1;
  return next<ssize_t (*)(int, const void*, std::size_t, off_t)>("pwrite")(descriptor, bytes, size, offset);
}
ssize_t pwrite64(int descriptor, const void* bytes, std::size_t size, off64_t offset) {
  if (refuses(descriptor)) return -1;
  return next<ssize_t (*)(int, const void*, std::size_t, off64_t)>("pwrite64")(descriptor, bytes, size, offset);
}
int ftruncate(int descriptor, off_t length) noexcept { return truncate_with("ftruncate", descriptor, length); }
int ftruncate64(int descriptor, off64_t length) noexcept { return truncate_with("ftruncate64", descriptor, length); }
int fallocate(int descriptor, int mode, off_t offset, off_t length) {
  if (refuses(descriptor)) return -1;
  return next<int (*)(int, int, off_t, off_t)>("fallocate")(descriptor, mode, offset, length);
}
int posix_fallocate(int descriptor, off_t offset, off_t length) {
  if (refuses(descriptor)) return ENOSPC;
  return next<int (*)(int, off_t, off_t)>("posix_fallocate")(descriptor, offset, length);
}
int posix_fallocate64(int descriptor, off64_t offset, off64_t length) {
  if (refuses(descriptor)) return ENOSPC;
  return next<int (*)(int, off64_t, off64_t)>("posix_fallocate64")(descriptor, offset, length);
}
int mkdir(const char* path, mode_t mode) noexcept {
  if (refuses_new(path_at(AT_FDCWD, path))) return -1;
  return next<int (*)(const char*, mode_t)>("mkdir")(path, mode);
}
int mkdirat(int folder, const char* path, mode_t mode) noexcept {
  if (refuses_new(path_at(folder, path))) return -1;
  return next<int (*)(int, const char*, mode_t)>("mkdirat")(folder, path, mode);
}
ssize_t sendfile(int to, int from, off_t* offset, std::size_t size) noexcept {
  if (refuses(to)) return -1;
  return next<ssize_t (*)(int, int, off_t*, std::size_t)>("sendfile")(to, from, offset, size);
}
ssize_t copy_file_range(int from, off64_t* from_offset, int to, off64_t* to_offset, std::size_t size, unsigned flags) {
  if (refuses(to)) return -1;
  using Copy = ssize_t (*)(int, off64_t*, int, off64_t*, std::size_t, unsigned);
  return next<Copy>("copy_file_range")(from, from_offset, to, to_offset, size, flags);
}

int rename(const char* from, const char* to) noexcept {
  const int code = next<int (*)(const char*, const char*)>("rename")(from, to);
  if (code == 0) removed(path_at(AT_FDCWD, from));
  return code;
}
int unlink(const char* path) noexcept {
  const auto whole = path_at(AT_FDCWD, path);
  const int code = next<int (*)(const char*)>("unlink")(path);
  if (code == 0) removed(whole);
  return code;
}
int remove(const char* path) noexcept {
  const auto whole = path_at(AT_FDCWD, path);
  const int code = next<int (*)(const char*)>("remove")(path);
  if (code == 0) removed(whole);
  return code;
}
int unlinkat(int folder, const char* path, int flags) noexcept {
  const auto whole = path_at(folder, path);
  const int code = next<int (*)(int, const char*, int)>("unlinkat")(folder, path, flags);
  if (code == 0) removed(whole);
  return code;
}

}  // extern "C"
