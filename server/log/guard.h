#pragma once

#include <chrono>
#include <string_view>
#include <thread>
#include <utility>

namespace semblante::log {

/// One error line for the exception that is being handled: "<where>: <what it says>". Call it inside a catch block.
void caught(std::string_view where) noexcept;

/// Runs `work`. An exception of any type is logged and ends `work` alone, not the thread that runs it. False when there
/// was one. Every thread of the server runs its work under this: an exception that leaves a thread ends the process.
template <class Work>
bool guarded(std::string_view where, Work&& work) noexcept {
  try {
    std::forward<Work>(work)();
    return true;
  } catch (...) {
    caught(where);
    return false;
  }
}

/// Runs the loop of a thread until it returns. One that throws is logged and, after a moment, begun again.
template <class Loop>
void keep_running(std::string_view where, Loop loop) noexcept {
  while (!guarded(where, loop)) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace semblante::log
