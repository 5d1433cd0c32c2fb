#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <unistd.h>

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509.h>

#include "server/app/installation_check.h"

namespace semblante {
namespace {

using Level = InstallationFinding::Level;

struct Free {
  void operator()(std::FILE* file) const { std::fclose(file); }
  void operator()(X509* certificate) const { X509_free(certificate); }
  void operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }
};
using File = std::unique_ptr<std::FILE, Free>;

/// Days from now until `time`; negative when it is past.
int days_until(const ASN1_TIME* time) {
  int days = 0;
  int seconds = 0;
  if (ASN1_TIME_diff(&days, &seconds, nullptr, time) != 1) return 0;
  return seconds < 0 ? days - 1 : days;
}

File open_file(InstallationFindings& findings, const std::filesystem::path& path) {
  File file(std::fopen(path.c_str(), "re"));
  if (!file)
    findings.push_back({Level::error, "TLS", path.string() + " cannot be read: " + std::strerror(errno),
                        "Give the account of the server the right to read it, or correct the path."});
  return file;
}

/// No prompt: a server has no terminal.
int no_password(char* /*buffer*/, int /*size*/, int /*for_writing*/, void* /*context*/) { return 0; }

}  // namespace

InstallationFindings check_certificate(const std::filesystem::path& certificate_path,
                                       const std::filesystem::path& key_path) {
  constexpr int soon = 14;
  InstallationFindings findings;
  const auto certificate_file = open_file(findings, certificate_path);
  const auto key_file = open_file(findings, key_path);
  if (!certificate_file || !key_file) return findings;
  const std::unique_ptr<X509, Free> certificate(PEM_read_X509(certificate_file.get(), nullptr, no_password, nullptr));
  const std::unique_ptr<EVP_PKEY, Free> key(PEM_read_PrivateKey(key_file.get(), nullptr, no_password, nullptr));
  if (!certificate)
    findings.push_back({Level::error, "TLS", certificate_path.string() + " is no certificate in PEM form",
                        "Name the file with the chain: -----BEGIN CERTIFICATE----- first."});
  if (!key)
    findings.push_back({Level::error, "TLS", key_path.string() + " is no private key in PEM form without a password",
                        "openssl pkey -in FILE -out NEW writes one without a password."});
  if (!certificate || !key) return findings;
  if (X509_check_private_key(certificate.get(), key.get()) != 1)
    findings.push_back({Level::error, "TLS", key_path.string() + " is not the key of " + certificate_path.string(),
                        "Name the two files that were made together."});
  const int days = days_until(X509_get0_notAfter(certificate.get()));
  if (X509_cmp_current_time(X509_get0_notBefore(certificate.get())) > 0)
    findings.push_back(
        {Level::error, "TLS", certificate_path.string() + " is not valid yet", "Check this machine's clock."});
  else if (days < 0)
    findings.push_back({Level::error, "TLS", certificate_path.string() + " has expired", "Renew the certificate."});
  else if (days < soon)
    findings.push_back({Level::warning, "TLS",
                        certificate_path.string() + " expires in " + std::to_string(days) + " days",
                        "Renew the certificate; see why that did not happen by itself."});
  else if (findings.empty())
    findings.push_back(
        {Level::ok, "TLS", certificate_path.string() + " is valid for " + std::to_string(days) + " days", ""});
  return findings;
}

}  // namespace semblante
