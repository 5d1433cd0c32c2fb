#include "server/app/certificate_files.h"

#include <utility>

#include "server/cli/command_failure.h"
#include "server/log/log.h"

namespace semblante {
namespace {

constexpr std::chrono::seconds look_interval{5};

void warn_if_old(const net::TlsContext& context, const std::filesystem::path& file) {
  constexpr std::chrono::hours soon{14 * 24};
  const auto left = context.expires() - std::chrono::system_clock::now();
  const auto days = std::chrono::duration_cast<std::chrono::hours>(left).count() / 24;
  if (left <= std::chrono::seconds(0))
    log::warning("the certificate " + file.string() + " has expired: clients refuse it");
  else if (left < soon)
    log::warning("the certificate " + file.string() + " expires in " + std::to_string(days) + " days");
}

}  // namespace

CertificateFiles::CertificateFiles(net::TlsFiles files, OnLoaded on_loaded)
    : files_(std::move(files)),
      on_loaded_(std::move(on_loaded)),
      seen_(changed()),
      watch_("looking for a new certificate", look_interval, [this](const auto&) { reload_if_changed(); }) {
  auto loaded = net::TlsContext::load(files_);
  if (!loaded) fail("serve", loaded.error());
  warn_if_old(**loaded, files_.certificate);
  on_loaded_(std::move(*loaded));
}

CertificateFiles::Times CertificateFiles::changed() const {
  std::error_code ignored;
  return {std::filesystem::last_write_time(files_.certificate, ignored),
          std::filesystem::last_write_time(files_.key, ignored)};
}

void CertificateFiles::reload() {
  const std::lock_guard lock(mutex_);
  seen_ = changed();
  auto loaded = net::TlsContext::load(files_);
  if (!loaded) {
    // A renewal writes two files: between the two they do not belong together. The second change is seen too.
    log::warning("the new certificate is not used: " + loaded.error().message);
    return;
  }
  warn_if_old(**loaded, files_.certificate);
  on_loaded_(std::move(*loaded));
  log::info("new connections use the certificate that is in " + files_.certificate.string() + " now");
}

void CertificateFiles::reload_if_changed() {
  {
    const std::lock_guard lock(mutex_);
    if (changed() == seen_) return;
  }
  reload();
}

}  // namespace semblante
