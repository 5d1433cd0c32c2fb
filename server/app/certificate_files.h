#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>

#include "server/log/periodic.h"
#include "server/net/tls_context.h"

namespace semblante {

/// Loads the certificate of a server again when its files change, and on request. A pair that cannot be used is logged,
/// and the last good one stays.
class CertificateFiles {
 public:
  using OnLoaded = std::function<void(std::shared_ptr<const net::TlsContext>)>;

  /// Calls `on_loaded` before it returns. Throws CommandFailure when the files cannot be used.
  CertificateFiles(net::TlsFiles files, OnLoaded on_loaded);
  /// Any thread.
  void reload();

 private:
  using Times = std::pair<std::filesystem::file_time_type, std::filesystem::file_time_type>;
  [[nodiscard]] Times changed() const;
  void reload_if_changed();

  const net::TlsFiles files_;
  const OnLoaded on_loaded_;
  std::mutex mutex_;
  Times seen_;  ///< guarded by mutex_
  log::Periodic watch_;
};

}  // namespace semblante
