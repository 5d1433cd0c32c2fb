#include "tests/support/tls_client.h"

#include <array>
#include <csignal>
#include <unistd.h>

#include <arpa/inet.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

namespace semblante::testing {

TlsClient::TlsClient(std::uint16_t port, int least_version, int greatest_version, int receive_buffer,
                     std::uint32_t address)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)), context_(SSL_CTX_new(TLS_client_method())) {
  std::signal(SIGPIPE, SIG_IGN);
  if (receive_buffer > 0) ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(address);
  SSL_CTX_set_min_proto_version(context_, least_version);
  SSL_CTX_set_max_proto_version(context_, greatest_version);
  SSL_CTX_set_cipher_list(context_, "ALL:@SECLEVEL=0");
  ssl_ = SSL_new(context_);
  SSL_set_fd(ssl_, socket_);
  connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0 && SSL_connect(ssl_) == 1;
  ERR_clear_error();
}

TlsClient::~TlsClient() {
  SSL_free(ssl_);
  SSL_CTX_free(context_);
  ::close(socket_);
}

std::string TlsClient::version() const { return SSL_get_version(ssl_); }

std::string TlsClient::certificate_name() const {
  X509* certificate = SSL_get1_peer_certificate(ssl_);
  std::array<char, 100> name{};
  if (certificate != nullptr)
    X509_NAME_get_text_by_NID(X509_get_subject_name(certificate), NID_commonName, name.data(), name.size());
  X509_free(certificate);
  return name.data();
}

bool TlsClient::send(std::string_view bytes) {
  ERR_clear_error();
  return SSL_write(ssl_, bytes.data(), static_cast<int>(bytes.size())) == static_cast<int>(bytes.size());
}

std::string TlsClient::read(std::size_t count) {
  std::string all(count, '\0');
  std::size_t have = 0;
  while (have < count) {
    ERR_clear_error();
    const int got = SSL_read(ssl_, all.data() + have, static_cast<int>(count - have));
    if (got <= 0) break;
    have += static_cast<std::size_t>(got);
  }
  all.resize(have);
  return all;
}

std::string TlsClient::read_head() {
  std::string head;
  while (!head.ends_with("\r\n\r\n")) {
    const auto more = read(1);
    if (more.empty()) break;
    head += more;
  }
  return head;
}

bool TlsClient::ended_cleanly() {
  char byte = 0;
  ERR_clear_error();
  const int got = SSL_read(ssl_, &byte, 1);
  return got <= 0 && SSL_get_error(ssl_, got) == SSL_ERROR_ZERO_RETURN;
}

void TlsClient::update_keys() { SSL_key_update(ssl_, SSL_KEY_UPDATE_REQUESTED); }

}  // namespace semblante::testing
