// Loaded into a process by LD_PRELOAD: the time of day is that of the machine plus SEMBLANTE_TEST_CLOCK seconds. Clocks
// that only run forward are left alone, as they are when somebody sets the clock of a machine.

#include <cstdlib>
#include <ctime>
#include <dlfcn.h>

#include <sys/time.h>

namespace {

long shift() {
  static const long seconds = [] {
    const char* text = std::getenv("SEMBLANTE_TEST_CLOCK");
    return text != nullptr ? std::strtol(text, nullptr, 10) : 0L;
  }();
  return seconds;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  static const auto real = next<int (*)(clockid_t, timespec*)>("clock_gettime");
  const int result = real(clock, time);
  if (result == 0 && (clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE)) time->tv_sec += shift();
  return result;
}

extern "C" int gettimeofday(timeval* time, void* zone) noexcept {
  static const auto real = next<int (*)(timeval*, void*)>("gettimeofday");
  const int result = real(time, zone);
  if (result == 0) time->tv_sec += shift();
  return result;
}

extern "C" time_t time(time_t* to) noexcept {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  if (to != nullptr) *to = now.tv_sec;
  return now.tv_sec;
}
