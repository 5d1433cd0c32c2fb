#include "server/cli/command_failure.h"

namespace semblante {

void fail(const std::string& what, const Error& error) {
  const bool ours = error.code == ErrorCode::internal || error.code == ErrorCode::io;
  const std::string where = error.where.empty() ? std::string() : error.where + ": ";
  const std::string helps = error.advice ? ": " + std::string(text_of(*error.advice).words) : std::string();
  throw CommandFailure(ours ? CommandFailure::internal : CommandFailure::bad_input,
                       what + ": " + where + error.message + helps);
}

}  // namespace semblante
