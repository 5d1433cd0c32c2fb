#include "server/upkeep/backup.h"

#include <map>
#include <optional>
#include <unordered_map>

#include <nlohmann/json.hpp>

#include "server/store/data_files.h"
#include "server/store/database_snapshot.h"
#include "server/store/records.h"
#include "server/store/store_error.h"
#include "server/upkeep/copy_file.h"

namespace semblante::upkeep {
namespace {

namespace fs = std::filesystem;
using store::DataFileKind;

/// Written last: a folder without it is not a complete backup.
constexpr const char* completed_name = "backup.json";
constexpr int most_attempts = 10;

Status make_empty_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return Error{ErrorCode::io, folder.string(), error.message()};
  if (!fs::is_empty(folder, error) || error)
    return Error{ErrorCode::mismatch, folder.string(), "the folder is not empty"};
  return Unit{};
}

/// The files of one kind in a copy of a data folder.
class Copies {
 public:
  Copies(const fs::path& from, const fs::path& to, DataFileKind kind) : from_(from), to_(to), kind_(kind) {}

  /// Copies a file unless that was done, or was tried and is known to be impossible. False when it is not there.
  /// `bytes`: the size of a file that does not grow any more; a copy of another size is made again.
  bool add(const std::string& name, std::optional<std::uint64_t> bytes) {
    const auto done = copied_.find(name);
    if (done != copied_.end() && (!bytes || done->second == *bytes)) return true;
    if (faults_.contains(name)) return true;
    const auto place = store::data_file_path(kind_, name);
    if (!store::is_real_file(from_ / place)) return false;
    std::error_code error;
    fs::create_directories((to_ / place).parent_path(), error);
    if (error) store::throw_store_error((to_ / place).parent_path(), error.value());
    const auto copy = copy_bytes(from_ / place, to_ / place);
    if (!copy && copy.error().code == ErrorCode::missing) return false;
    if (!copy) {
      fail(name, copy.error().message);
    } else if (kind_ == DataFileKind::blob && copy->sha256 != name) {
      fs::remove(to_ / place, error);
      fail(name, "its bytes are damaged");
    } else {
      copied_[name] = copy->bytes;
    }
    return true;
  }
  void fail(const std::string& name, const std::string& reason) { faults_[name] = reason; }

  /// Removes the copies that are not `known`: their records were removed during the backup.
  template <class Known>
  void keep_only(const Known& known) {
    std::erase_if(faults_, [&](const auto& fault) { return !known.contains(fault.first); });
    std::erase_if(copied_, [&](const auto& copy) {
      if (known.contains(copy.first)) return false;
      std::error_code ignored;
      fs::remove(to_ / store::data_file_path(kind_, copy.first), ignored);
      return true;
    });
  }

  void count(std::uint64_t& files, std::uint64_t& bytes, std::vector<std::string>& faults) const {
    for (const auto& [name, size] : copied_) {
      ++files;
      bytes += size;
    }
    const std::string what = kind_ == DataFileKind::blob ? "blob " : "recording ";
    for (const auto& [name, reason] : faults_)
      faults.push_back(std::string(what).append(name).append(": ").append(reason));
  }

 private:
  const fs::path from_, to_;
  const DataFileKind kind_;
  std::unordered_map<std::string, std::uint64_t> copied_;  ///< sizes
  std::map<std::string, std::string> faults_;
};

/// Copies the database, and what it refers to. False when a file has gone since the database was copied: then a user
/// has removed it, and the next copy of the database does not know it. `is_last`: such a file is a fault.
Result<bool> copy_one_moment(const fs::path& data, const fs::path& to, Copies& blobs, Copies& recordings,
                             bool is_last) {
  const auto database = to / store::database_file_name;
  std::error_code ignored;
  fs::remove(database, ignored);
  if (auto copied = store::copy_database(data / store::database_file_name, database); !copied) return copied.error();
  const auto known = store::read_database(database, store::Reading::everything);
  if (!known) return known.error();
  if (!known->damage.empty()) return Error{ErrorCode::io, "", "the database is damaged: " + known->damage.front()};
  bool is_complete = true;
  const auto add = [&](Copies& copies, const std::string& name, std::optional<std::uint64_t> bytes) {
    if (copies.add(name, bytes)) return;
    is_complete = false;
    if (is_last) copies.fail(name, "it is missing");
  };
  for (const auto& [hash, blob] : known->blobs) add(blobs, hash, std::nullopt);
  for (const auto& [id, record] : known->recordings) {
    const bool runs = record.state == store::RecordingState::recording;
    // A running one is copied anew, since its file has grown.
    add(recordings, id, runs ? UINT64_MAX : record.bytes);
  }
  if (is_complete || is_last) {
    blobs.keep_only(known->blobs);
    recordings.keep_only(known->recordings);
  }
  return is_complete || is_last;
}

/// Copies the certificate of `serve --lan`, if there is one: phones have accepted it, and accept no other.
Result<bool> copy_home_certificate(const fs::path& from, const fs::path& to) {
  for (const auto& name : store::home_certificate_files)
    if (!store::is_real_file(from / name)) return false;
  for (const auto& name : store::home_certificate_files) {
    std::error_code error;
    fs::create_directories((to / name).parent_path(), error);
    if (error) store::throw_store_error((to / name).parent_path(), error.value());
    if (const auto copy = copy_bytes(from / name, to / name); !copy) return copy.error();
  }
  return true;
}

std::string completed_text(const BackupReport& report) {
  nlohmann::ordered_json json;
  json["created"] = store::timestamp_now();
  json["blobs"] = {{"files", report.blobs}, {"bytes", report.blob_bytes}};
  json["recordings"] = {{"files", report.recordings}, {"bytes", report.recording_bytes}};
  json["home_certificate"] = report.home_certificate;
  json["faults"] = report.faults;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

BackupReport report_of(const Copies& blobs, const Copies& recordings) {
  BackupReport report;
  blobs.count(report.blobs, report.blob_bytes, report.faults);
  recordings.count(report.recordings, report.recording_bytes, report.faults);
  return report;
}

}  // namespace

Result<BackupReport> back_up(const fs::path& data, const fs::path& to) {
  // Before the folder is made: a mistyped --data leaves nothing behind.
  if (!store::is_real_file(data / store::database_file_name))
    return Error{ErrorCode::missing, data.string(), "there is no database in this folder"};
  if (auto made = make_empty_folder(to); !made) return made.error();
  Copies blobs(data, to, DataFileKind::blob);
  Copies recordings(data, to, DataFileKind::recording);
  // Most of the bytes, before the database, so that little time passes between its copy and the last blob's.
  const auto files = store::list_data_files(data, DataFileKind::blob);
  if (!files) return files.error();
  for (const auto& file : *files) blobs.add(file.name, std::nullopt);
  for (int attempt = 1;; ++attempt) {
    const auto done = copy_one_moment(data, to, blobs, recordings, attempt == most_attempts);
    if (!done) return done.error();
    if (*done) break;
  }
  const auto certificate = copy_home_certificate(data, to);
  if (!certificate) return certificate.error();
  auto report = report_of(blobs, recordings);
  report.home_certificate = *certificate;
  sync_file_system(to);
  write_durably(to / completed_name, completed_text(report));
  return report;
}

Result<BackupReport> restore(const fs::path& backup, const fs::path& data) {
  if (!store::is_real_file(backup / completed_name) || !store::is_real_file(backup / store::database_file_name))
    return Error{ErrorCode::missing, backup.string(), "this is no backup, or one that was not completed"};
  const auto known = store::read_database(backup / store::database_file_name, store::Reading::everything);
  if (!known) return known.error();
  if (!known->damage.empty()) return Error{ErrorCode::io, "", "the database is damaged: " + known->damage.front()};
  if (auto made = make_empty_folder(data); !made) return made.error();
  Copies blobs(backup, data, DataFileKind::blob);
  Copies recordings(backup, data, DataFileKind::recording);
  for (const auto& [hash, blob] : known->blobs)
    if (!blobs.add(hash, std::nullopt)) blobs.fail(hash, "it is missing");
  for (const auto& [id, record] : known->recordings)
    if (!recordings.add(id, std::nullopt)) recordings.fail(id, "it is missing");
  const auto certificate = copy_home_certificate(backup, data);
  if (!certificate) return certificate.error();
  sync_file_system(data);
  // Last: until then the folder has no database, and nothing takes it for a data folder.
  if (auto copied = store::copy_database(backup / store::database_file_name, data / store::database_file_name); !copied)
    return copied.error();
  auto report = report_of(blobs, recordings);
  report.home_certificate = *certificate;
  return report;
}

std::string to_text(const BackupReport& report) {
  std::string text;
  for (const auto& fault : report.faults) text.append("not copied: ").append(fault).append("\n");
  return text + std::to_string(report.blobs) + " blobs (" + std::to_string(report.blob_bytes) + " bytes) and " +
         std::to_string(report.recordings) + " recordings (" + std::to_string(report.recording_bytes) + " bytes)" +
         (report.home_certificate ? ", and the certificate of serve --lan with its key" : "") + "\n";
}

}  // namespace semblante::upkeep
