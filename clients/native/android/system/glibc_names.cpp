// Debian's headers and C++ library for aarch64 are made for glibc. Where its names or structs are not those of
// Android's C library, they are here, by what Android has.

#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <dlfcn.h>
#include <ios>
#include <link.h>
#include <netdb.h>
#include <pthread.h>
#include <utility>

/// Draco's files include <iostream> and use no stream: without this all of the C++ library's locales would be linked,
/// which read glibc's tables.
std::ios_base::Init::Init() {}
std::ios_base::Init::~Init() {}

extern "C" {

/// Of a library that is linked without the compiler's start files.
__attribute__((visibility("hidden"))) void* __dso_handle = nullptr;

/// Threads of the system are there before ours: counters of references are always atomic.
char __libc_single_threaded = 0;

int* __errno();  // Android's
int* __errno_location() noexcept { return __errno(); }

void __assert2(const char* file, int line, const char* function, const char* text);  // Android's
void __assert_fail(const char* text, const char* file, unsigned line, const char* function) noexcept {
  __assert2(file, static_cast<int>(line), function, text);
  std::abort();
}

int __printf_chk(int /*flag*/, const char* format, ...) {
  va_list values;
  va_start(values, format);
  const int written = std::vprintf(format, values);
  va_end(values);
  return written;
}

/// Of the words of exceptions: Android has no translations.
char* gettext(const char* text) noexcept { return const_cast<char*>(text); }

unsigned long getauxval(unsigned long type) noexcept;
unsigned long __getauxval(unsigned long type) { return getauxval(type); }

/// Waits until a time of any clock: Android has it from API 30. Android's own wait takes the time of day.
int pthread_cond_clockwait(pthread_cond_t* condition, pthread_mutex_t* mutex, clockid_t clock, const timespec* until) {
  constexpr std::int64_t second = 1'000'000'000;
  const auto nanoseconds = [](const timespec& t) { return t.tv_sec * second + t.tv_nsec; };
  timespec now{};
  timespec day{};
  clock_gettime(clock, &now);
  clock_gettime(CLOCK_REALTIME, &day);
  const std::int64_t end = nanoseconds(day) + nanoseconds(*until) - nanoseconds(now);
  const timespec end_of_day = {end / second, end % second};
  return pthread_cond_timedwait(condition, mutex, &end_of_day);
}

/// Where the tables of exceptions of the code at `address` are. Called by the C++ library when something is thrown.
int _dl_find_object(void* address, dl_find_object* found) noexcept {
  struct Search {
    std::uintptr_t address;
    dl_find_object* found;
  } search{reinterpret_cast<std::uintptr_t>(address), found};
  const auto look = [](dl_phdr_info* object, std::size_t /*size*/, void* data) {
    const auto& wanted = *static_cast<Search*>(data);
    bool is_it = false;
    void* tables = nullptr;
    std::uintptr_t begin = UINTPTR_MAX;
    std::uintptr_t end = 0;
    for (int i = 0; i < object->dlpi_phnum; ++i) {
      const auto& part = object->dlpi_phdr[i];
      const std::uintptr_t at = object->dlpi_addr + part.p_vaddr;
      if (part.p_type == PT_GNU_EH_FRAME) tables = reinterpret_cast<void*>(at);
      if (part.p_type != PT_LOAD) continue;
      begin = at < begin ? at : begin;
      end = at + part.p_memsz > end ? at + part.p_memsz : end;
      is_it = is_it || (wanted.address >= at && wanted.address < at + part.p_memsz);
    }
    if (!is_it || tables == nullptr) return 0;
    *wanted.found = {};
    wanted.found->dlfo_map_start = reinterpret_cast<void*>(begin);
    wanted.found->dlfo_map_end = reinterpret_cast<void*>(end);
    wanted.found->dlfo_eh_frame = tables;
    return 1;
  };
  return dl_iterate_phdr(look, &search) == 1 ? 0 : -1;
}

// The two pointers of an address are in the other order in Android's struct addrinfo.
int __real_getaddrinfo(const char* host, const char* service, const addrinfo* wish, addrinfo** list);
void __real_freeaddrinfo(addrinfo* list);

static void swap_pointers(addrinfo* list) {
  for (; list != nullptr; list = list->ai_next) {
    auto* const address = list->ai_addr;
    list->ai_addr = reinterpret_cast<sockaddr*>(list->ai_canonname);
    list->ai_canonname = reinterpret_cast<char*>(address);
  }
}

int __wrap_getaddrinfo(const char* host, const char* service, const addrinfo* wish, addrinfo** list) {
  const int problem = __real_getaddrinfo(host, service, wish, list);
  if (problem == 0) swap_pointers(*list);
  return problem;
}

void __wrap_freeaddrinfo(addrinfo* list) {
  swap_pointers(list);
  __real_freeaddrinfo(list);
}

}  // extern "C"
