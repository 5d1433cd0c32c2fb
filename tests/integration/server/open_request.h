#pragma once

#include <string>

#include "tests/integration/server/test_client.h"

namespace semblante::test {

/// A connection that is kept: requests are sent in pieces, and their answers are waited for.
class OpenRequest {
 public:
  OpenRequest(int port, std::string_view begin);
  ~OpenRequest();
  OpenRequest(const OpenRequest&) = delete;
  OpenRequest& operator=(const OpenRequest&) = delete;

  void send(std::string_view bytes);
  /// The next answer with a Content-Length; status 0 when the connection ends before it.
  Reply answer();

 private:
  int socket_ = -1;
  std::string buffer_;
};

}  // namespace semblante::test
