#include "server/app/service_manager.h"

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <unistd.h>

#include <sys/socket.h>
#include <sys/un.h>

#include "server/log/log.h"

namespace semblante {

void notify_service_manager(std::string_view state) {
  const char* name = std::getenv("NOTIFY_SOCKET");
  if (name == nullptr || *name == '\0') return;
  const std::string path(name);
  sockaddr_un address{};
  if ((path[0] != '/' && path[0] != '@') || path.size() >= sizeof address.sun_path) {
    log::warning("NOTIFY_SOCKET is not the path of a socket");
    return;
  }
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.data(), path.size());
  if (path[0] == '@') address.sun_path[0] = '\0';  // an abstract name
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path.size());
  const int socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const auto* const target = reinterpret_cast<const sockaddr*>(&address);
  if (socket < 0 || ::sendto(socket, state.data(), state.size(), MSG_NOSIGNAL, target, length) < 0)
    log::warning(std::string("the service manager cannot be notified: ") + std::strerror(errno));
  if (socket >= 0) ::close(socket);
}

}  // namespace semblante
