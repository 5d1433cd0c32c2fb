#include "server/net/self_signed.h"

#include <array>
#include <cstdio>
#include <memory>

#include <openssl/ec.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include "server/http/address_range.h"

namespace semblante::net {
namespace {

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

/// Caught within this file.
struct Fault {
  std::string what;
};

void require(bool done, const char* what) {
  if (!done) throw Fault{std::string("OpenSSL cannot ") + what};
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

Certificate make_certificate(EVP_PKEY* key, const std::string& common_name, const std::vector<std::string>& names,
                             std::chrono::seconds validity) {
  Certificate certificate(X509_new());
  require(certificate != nullptr, "make a certificate");
  X509_set_version(certificate.get(), 2);
  std::array<unsigned char, 16> serial{};
  require(RAND_bytes(serial.data(), serial.size()) == 1, "make random numbers");
  serial[0] &= 0x7FU;  // a serial number is positive
  const std::unique_ptr<BIGNUM, Freed<BN_free>> number(BN_bin2bn(serial.data(), serial.size(), nullptr));
  BN_to_ASN1_INTEGER(number.get(), X509_get_serialNumber(certificate.get()));
  X509_gmtime_adj(X509_getm_notBefore(certificate.get()), -3600L);  // clocks of phones differ
  X509_gmtime_adj(X509_getm_notAfter(certificate.get()), static_cast<long>(validity.count()));
  X509_set_pubkey(certificate.get(), key);
  auto* const name = X509_get_subject_name(certificate.get());
  X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, reinterpret_cast<const unsigned char*>(common_name.c_str()), -1,
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
    throw Fault{path.string() + " cannot be written"};
}

}  // namespace

Status write_self_signed(const TlsFiles& files, const std::string& common_name, const std::vector<std::string>& names,
                         std::chrono::seconds validity) {
  try {
    const Key key(EVP_EC_gen("P-256"));
    require(key != nullptr, "make a key");
    const auto certificate = make_certificate(key.get(), common_name, names, validity);
    write_pem(files.key, [&](std::FILE* file) {
      return PEM_write_PrivateKey(file, key.get(), nullptr, nullptr, 0, nullptr, nullptr);
    });
    write_pem(files.certificate, [&](std::FILE* file) { return PEM_write_X509(file, certificate.get()); });
    return Unit{};
  } catch (const Fault& fault) {
    return Error{ErrorCode::io, "", fault.what};
  }
}

}  // namespace semblante::net
