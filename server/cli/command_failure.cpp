#include "server/cli/command_failure.h"

namespace semblante {

void fail(const std::string& what, const Error& error) {
  const bool ours = error.code == ErrorCode::internal || error.code == ErrorCode::io;
  const std::string where = error.where.empty() ? std::string() : error.where + ": ";
  throw CommandFailure(ours ? CommandFailure::internal : CommandFailure::bad_input,
                       what + ": " + where + error.message);
}

}  // namespace semblante
