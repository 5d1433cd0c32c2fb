#include "server/app/lan.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ifaddrs.h>
#include <memory>
#include <qrencode.h>

#include <arpa/inet.h>
#include <net/if.h>
#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include "server/cli/command_failure.h"
#include "server/http/address_range.h"

namespace semblante {
namespace {

constexpr long valid_seconds = 397L * 24 * 3600;  ///< clients refuse longer ones
constexpr std::chrono::hours least_left{24 * 7};

template <auto Free>
struct Freed {
  template <class T>
  void operator()(T* object) const {
    Free(object);
  }
};
using Key = std::unique_ptr<EVP_PKEY, Freed<EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, Freed<X509_free>>;
using File = std::unique_ptr<std::FILE, Freed<std::fclose>>;

[[noreturn]] void fail_certificate(const std::string& what) {
  throw CommandFailure(CommandFailure::internal, "serve: --lan: " + what);
}

void require(bool done, const char* what) {
  if (!done) fail_certificate(std::string("OpenSSL cannot ") + what);
}

std::string alternative_names(const std::vector<std::string>& names) {
  std::string list;
  for (const auto& name : names)
    list.append(list.empty() ? "" : ",").append(http::parse_address(name) ? "IP:" : "DNS:").append(name);
  return list;
}

void add_extension(X509* certificate, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
  const std::unique_ptr<X509_EXTENSION, Freed<X509_EXTENSION_free>> extension(
      X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()));
  require(extension && X509_add_ext(certificate, extension.get(), -1) == 1, "extend a certificate");
}

Certificate make_certificate(EVP_PKEY* key, const std::vector<std::string>& names) {
  Certificate certificate(X509_new());
  require(certificate != nullptr, "make a certificate");
  X509_set_version(certificate.get(), 2);
  std::array<unsigned char, 16> serial{};
  require(RAND_bytes(serial.data(), serial.size()) == 1, "make random numbers");
  serial[0] &= 0x7FU;  // a serial number is positive
  const std::unique_ptr<BIGNUM, Freed<BN_free>> number(BN_bin2bn(serial.data(), serial.size(), nullptr));
  BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate.get()));
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -3600L);  // clocks of phones differ
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), valid_seconds);
  X509_set_pubkey(certificate.get(), key);
  auto* const name = X509_get_subject_name(certificate.get());
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>("Semblante at home"), -1,
                             -1, 0);
  X509_set_issuer_name(certificate.get(), name);
  add_extension(certificate.get(), NID_subject_alt_name, alternative_names(names));
  add_extension(certificate.get(), NID_basic_constraints, "critical,CA:FALSE");
  add_extension(certificate.get(), NID_ext_key_usage, "serverAuth");
  require(X509_sign(certificate.get(), key, EVP_sha256()) != 0, "sign a certificate");
  return certificate;
}

template <class Write>
void write_pem(const std::filesystem::path& path, Write write) {
  const File file(std::fopen(path.c_str(), "w"));
  if (!file || write(file.get()) != 1 || std::fflush(file.get()) != 0)
    fail_certificate(path.string() + " cannot be written");
}

bool still_serves(const net::TlsFiles& files, const std::vector<std::string>& names) {
  const auto loaded = net::TlsContext::load(files);
  if (!loaded || (*loaded)->expires() < std::chrono::system_clock::now() + least_left) return false;
  const auto& known = (*loaded)->names();
  return std::all_of(names.begin(), names.end(),
                     [&](const auto& name) { return std::find(known.begin(), known.end(), name) != known.end(); });
}

bool serves_a_network(const ifaddrs& one) {
  return one.ifa_addr != nullptr && (one.ifa_flags & IFF_UP) != 0 && (one.ifa_flags & IFF_LOOPBACK) == 0;
}

}  // namespace

std::vector<std::string> network_addresses() {
  ifaddrs* list = nullptr;
  if (::getifaddrs(&list) != 0) return {};
  const std::unique_ptr<ifaddrs, Freed<::freeifaddrs>> owner(list);
  std::vector<std::string> four, six;
  std::array<char, INET6_ADDRSTRLEN> text{};
  for (const auto* one = list; one != nullptr; one = one->ifa_next) {
    if (!serves_a_network(*one)) continue;
    if (one->ifa_addr->sa_family == AF_INET) {
      const auto& address = reinterpret_cast<const sockaddr_in*>(one->ifa_addr)->sin_addr;
      if (::inet_ntop(AF_INET, &address, text.data(), text.size()) != nullptr) four.emplace_back(text.data());
    } else if (one->ifa_addr->sa_family == AF_INET6) {
      const auto& address = reinterpret_cast<const sockaddr_in6*>(one->ifa_addr)->sin6_addr;
      if (IN6_IS_ADDR_LINKLOCAL(&address)) continue;
      if (::inet_ntop(AF_INET6, &address, text.data(), text.size()) != nullptr) six.emplace_back(text.data());
    }
  }
  four.insert(four.end(), six.begin(), six.end());
  return four;
}

net::TlsFiles self_signed_certificate(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) fail_certificate(folder.string() + ": " + error.message());
  const net::TlsFiles files{folder / "certificate.pem", folder / "key.pem"};
  if (std::filesystem::exists(files.certificate, error) && still_serves(files, names)) return files;
  const Key key(EVP_EC_gen("P-256"));
  require(key != nullptr, "make a key");
  const auto certificate = make_certificate(key.get(), names);
  write_pem(files.key, [&](std::FILE* file) {
    return PEM_write_PrivateKey(file, key.get(), nullptr, nullptr, 0, nullptr, nullptr);
  });
  write_pem(files.certificate, [&](std::FILE* file) { return PEM_write_X509(file, certificate.get()); });
  return files;
}

std::string qr_code(std::string_view text) {
  const std::unique_ptr<QRcode, Freed<QRcode_free>> code(
      QRcode_encodeString8bit(std::string(text).c_str(), 0, QR_ECLEVEL_L));
  if (!code) return {};
  constexpr int margin = 4;  // as the standard asks
  const auto dark = [&](int row, int column) {
    if (row < 0 || column < 0 || row >= code->width || column >= code->width) return false;
    return (code->data[row * code->width + column] & 1U) != 0;
  };
  // Two rows in a line; black on white, whatever the colours of the terminal.
  std::string lines;
  for (int row = -margin; row < code->width + margin; row += 2) {
    lines += "\x1b[30;107m";
    for (int column = -margin; column < code->width + margin; ++column) {
      const bool upper = dark(row, column), lower = dark(row + 1, column);
      lines += upper && lower ? "█" : upper ? "▀" : lower ? "▄" : " ";
    }
    lines += "\x1b[0m\n";
  }
  return lines;
}

}  // namespace semblante
