#include "server/api/storage_problems.h"

#include "server/api/common.h"

namespace semblante::api {
namespace {

std::string_view slug_of(bool disk_full) { return disk_full ? "insufficient-storage" : "storage-unavailable"; }

}  // namespace

http::Problem problem_of(const store::StoreError& error) {
  const bool disk_full = dynamic_cast<const store::DiskFull*>(&error) != nullptr;
  if (dynamic_cast<const store::NotEnoughRoom*>(&error) != nullptr)
    return http::make_problem(slug_of(disk_full), "the disk is nearly full");
  return http::make_problem(slug_of(disk_full),
                            disk_full ? "the disk of the server is full"
                                      : "the server cannot read or write its data folder: its log says why");
}

http::Problem problem_of(const store::DamagedBlob& error) { return http::make_problem("damaged-data", error.what()); }

void refuse_unkept(const Error& error) {
  throw store::StoreError(error.where.empty() ? error.message : error.where + ": " + error.message);
}

void refuse_pending(const Context& context, const std::string& effect) {
  const auto status = context.pending.status();
  refuse(slug_of(status.disk_full || status.writable), effect +
                                                           ", but the change is not stored yet: it will be when the "
                                                           "disk can be written; a restart before that undoes it");
}

std::string pending_in_words(const store::PendingStatus& status) {
  if (status.count == 0) return {};
  std::string text = std::to_string(status.count) + (status.count == 1 ? " change waits" : " changes wait");
  text.append(" to be recorded: ");
  for (std::size_t i = 0; i < status.what.size(); ++i) text.append(i == 0 ? "" : ", ").append(status.what[i]);
  if (status.count > status.what.size()) text.append(", ...");
  return text;
}

}  // namespace semblante::api
