#include "server/net/tls_context.h"

#include <array>
#include <ctime>
#include <string_view>

#include <arpa/inet.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>

#include "server/net/tls_session.h"

namespace semblante::net {
namespace {

/// Ephemeral keys (forward secrecy) and authenticated ciphers only. TLS 1.3 has no others.
constexpr const char* tls_12_ciphers =
    "ECDHE-ECDSA-AES128-GCM-SHA256:ECDHE-RSA-AES128-GCM-SHA256:ECDHE-ECDSA-CHACHA20-POLY1305:"
    "ECDHE-RSA-CHACHA20-POLY1305:ECDHE-ECDSA-AES256-GCM-SHA384:ECDHE-RSA-AES256-GCM-SHA384";

/// The first error that OpenSSL noted on this thread.
std::string noted_error() {
  const auto code = ERR_get_error();
  ERR_clear_error();
  if (const char* reason = ERR_reason_error_string(code)) return reason;
  return "not readable";
}

/// A server of this protocol speaks HTTP/1.1 only; a client that offers other protocols and not this one continues
/// without (RFC 7301 lets the server ignore the offer).
int select_protocol(SSL*, const unsigned char** out, unsigned char* out_length, const unsigned char* offered,
                    unsigned offered_length, void*) {
  static constexpr std::array<unsigned char, 9> ours = {8, 'h', 't', 't', 'p', '/', '1', '.', '1'};
  unsigned char* selected = nullptr;
  const int found = SSL_select_next_proto(&selected, out_length, ours.data(), ours.size(), offered, offered_length);
  if (found != OPENSSL_NPN_NEGOTIATED) return SSL_TLSEXT_ERR_NOACK;
  *out = selected;
  return SSL_TLSEXT_ERR_OK;
}

std::chrono::system_clock::time_point time_of(const ASN1_TIME* time) {
  std::tm utc{};
  if (ASN1_TIME_to_tm(time, &utc) != 1) return {};
  return std::chrono::system_clock::from_time_t(timegm(&utc));
}

std::vector<std::string> names_of(const X509* certificate) {
  std::vector<std::string> names;
  auto* list = static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(certificate, NID_subject_alt_name, nullptr, nullptr));
  for (int i = 0; i < sk_GENERAL_NAME_num(list); ++i) {
    const auto* name = sk_GENERAL_NAME_value(list, i);
    if (name->type != GEN_DNS && name->type != GEN_IPADD) continue;
    const auto* text = name->type == GEN_DNS ? name->d.dNSName : name->d.iPAddress;
    const auto* data = ASN1_STRING_get0_data(text);
    const auto size = static_cast<std::size_t>(ASN1_STRING_length(text));
    if (name->type == GEN_DNS) {
      std::string host(reinterpret_cast<const char*>(data), size);
      if (host.find('*') == std::string::npos) names.push_back(std::move(host));
    } else {
      std::array<char, INET6_ADDRSTRLEN> address{};
      if (::inet_ntop(size == sizeof(in_addr) ? AF_INET : AF_INET6, data, address.data(), address.size()) != nullptr)
        names.emplace_back(address.data());
    }
  }
  GENERAL_NAMES_free(list);
  return names;
}

/// A key with a passphrase is refused instead of asking for it on the terminal.
int no_passphrase(char*, int, int, void*) { return -1; }

}  // namespace

Result<std::shared_ptr<const TlsContext>> TlsContext::load(const TlsFiles& files) {
  ERR_clear_error();
  SSL_CTX* raw = SSL_CTX_new(TLS_server_method());
  if (raw == nullptr) return Error{ErrorCode::io, "--tls-cert", "OpenSSL cannot be started: " + noted_error()};
  const std::shared_ptr<TlsContext> context(new TlsContext(raw));
  SSL_CTX_set_min_proto_version(raw, TLS1_2_VERSION);
  SSL_CTX_set_cipher_list(raw, tls_12_ciphers);
  SSL_CTX_set_options(raw, SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE | SSL_OP_NO_COMPRESSION |
                               SSL_OP_PRIORITIZE_CHACHA);
#ifdef SSL_OP_ENABLE_KTLS
  // The kernel encrypts, where it can.
  SSL_CTX_set_options(raw, SSL_OP_ENABLE_KTLS);
#endif
  // Partial writes: as much as the socket accepts, like send(). Moving buffer: what waits may be copied meanwhile.
  // Released buffers: an idle connection does not keep 34 KiB.
  SSL_CTX_set_mode(raw, SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER | SSL_MODE_RELEASE_BUFFERS);
  SSL_CTX_set_alpn_select_cb(raw, select_protocol, nullptr);
  SSL_CTX_set_default_passwd_cb(raw, no_passphrase);
  if (SSL_CTX_use_certificate_chain_file(raw, files.certificate.c_str()) != 1)
    return Error{ErrorCode::malformed, "--tls-cert",
                 files.certificate.string() + " is no certificate in PEM: " + noted_error()};
  if (SSL_CTX_use_PrivateKey_file(raw, files.key.c_str(), SSL_FILETYPE_PEM) != 1)
    return Error{ErrorCode::malformed, "--tls-key",
                 files.key.string() +
                     " is not the private key of the certificate, in PEM without a passphrase: " + noted_error()};
  const auto* certificate = SSL_CTX_get0_certificate(raw);
  context->expires_ = time_of(X509_get0_notAfter(certificate));
  context->names_ = names_of(certificate);
  return std::shared_ptr<const TlsContext>(context);
}

TlsContext::~TlsContext() { SSL_CTX_free(context_); }

std::shared_ptr<TlsSession> TlsContext::session(int descriptor) const {
  return std::make_shared<TlsSession>(context_, descriptor);
}

}  // namespace semblante::net
