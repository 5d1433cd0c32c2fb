#include "server/net/handshake.h"

#include <utility>

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/strand.hpp>

#include "server/net/http_session.h"
#include "server/net/log_fault.h"
#include "server/net/transport.h"

namespace semblante::net {

namespace asio = boost::asio;

asio::awaitable<void> shake_hands(asio::ip::tcp::socket socket, std::shared_ptr<const TlsContext> context,
                                  std::shared_ptr<SharedState> state, ConnectionCount count) {
  boost::system::error_code ignored;
  socket.native_non_blocking(true, ignored);  // OpenSSL uses the descriptor itself
  auto tls = context->session(socket.native_handle());
  context.reset();  // a connection lives longer than a certificate is valid for new ones
  Transport transport(std::move(socket), tls);
  transport.expires_after(state->config.limits.header_timeout);
  if (co_await transport.handshake()) co_return;
  count.handshake_done();
  auto secured = transport.release_socket();
  const auto protocol = secured.local_endpoint().protocol();
  asio::ip::tcp::socket moved(asio::make_strand(state->io), protocol, secured.release());
  const auto executor = moved.get_executor();
  asio::co_spawn(executor, serve_connection(std::move(moved), std::move(tls), std::move(state), std::move(count)),
                 log_fault);
}

}  // namespace semblante::net
