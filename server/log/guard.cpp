#include "server/log/guard.h"

#include <exception>
#include <string>

#include "server/log/log.h"

namespace semblante::log {
namespace {

std::string words_of_current_exception() {
  try {
    throw;
  } catch (const std::exception& fault) {
    return fault.what();
  } catch (...) {
    return "an exception of an unknown type";
  }
}

}  // namespace

void caught(std::string_view where) noexcept {
  try {
    error(std::string(where) + ": " + words_of_current_exception());
  } catch (...) {  // NOLINT(bugprone-empty-catch): without memory the line is dropped
  }
}

}  // namespace semblante::log
