#pragma once

#include <filesystem>
#include <string>

namespace semblante::testing {

/// A self-signed certificate with its key, as PEM files.
struct CertificateFiles {
  std::filesystem::path certificate, key;
};

/// Makes them in `folder` for localhost and 127.0.0.1; `name` is the common name, by which a client tells two apart.
CertificateFiles make_certificate(const std::filesystem::path& folder, const std::string& name,
                                  long valid_seconds = 3600);

}  // namespace semblante::testing
