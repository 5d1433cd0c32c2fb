#include "server/upkeep/check.h"

#include <array>
#include <chrono>
#include <functional>
#include <optional>
#include <unordered_set>
#include <utility>

#include <nlohmann/json.hpp>

#include "server/recordings/recording_reader.h"
#include "server/store/data_files.h"
#include "server/store/database_snapshot.h"
#include "server/store/descriptor.h"
#include "server/store/file_hash.h"
#include "server/store/reconcile.h"
#include "server/store/verified_blobs.h"
#include "server/upkeep/data_lock.h"

namespace semblante::upkeep {
namespace {

namespace fs = std::filesystem;
using store::DatabaseSnapshot;
using store::DataFileKind;

constexpr auto kind_names = std::to_array<std::string_view>({
    "damaged-database",
    "missing-row",
    "missing-blob",
    "damaged-blob",
    "missing-recording",
    "damaged-recording",
    "unknown-blob",
    "unknown-recording",
});

std::string users_in_words(const std::set<std::string>& users) {
  constexpr std::size_t most_named = 5;
  std::string text;
  std::size_t number = 0;
  for (const auto& user : users) {
    if (number == most_named) return text + " and " + std::to_string(users.size() - most_named) + " more";
    text.append(number++ == 0 ? "of " : ", ").append(user);
  }
  return text;
}

/// One check of one folder.
class Checker {
 public:
  explicit Checker(const fs::path& data) : data_(data), file_(data / store::database_file_name) {}

  Result<CheckReport> run() {
    report_.server_runs = is_server_running(data_);
    // Listed before the database is read: a file that a running server adds has its record by then, or soon.
    const auto blobs = store::list_data_files(data_, DataFileKind::blob);
    if (!blobs) return blobs.error();
    const auto recordings = store::list_data_files(data_, DataFileKind::recording);
    if (!recordings) return recordings.error();
    auto snapshot = store::read_database(file_, store::Reading::everything);
    if (!snapshot) {
      if (snapshot.error().code != ErrorCode::malformed) return snapshot.error();
      add({FaultKind::damaged_database, "", snapshot.error().message});
      return std::move(report_);
    }
    known_ = std::move(*snapshot);
    for (const auto& line : known_.damage) add({FaultKind::damaged_database, "", line});
    for (const auto& line : known_.references) add({FaultKind::missing_row, "", line});
    for (const auto& [hash, blob] : known_.blobs) check_blob(hash, blob);
    for (const auto& [id, record] : known_.recordings) check_recording(id, record);
    for (const auto& file : *blobs)
      if (!known_.blobs.contains(file.name)) suspects_.push_back({FaultKind::unknown_blob, file.name, ""});
    for (const auto& file : *recordings)
      if (!known_.recordings.contains(file.name)) suspects_.push_back({FaultKind::unknown_recording, file.name, ""});
    if (auto judged = judge(); !judged) return judged.error();
    return std::move(report_);
  }

 private:
  void add(Fault fault) { report_.faults.push_back(std::move(fault)); }
  [[nodiscard]] fs::path path_of(DataFileKind kind, const std::string& name) const {
    return data_ / store::data_file_path(kind, name);
  }

  /// Words for what is wrong with the file; empty: nothing. nullopt: it does not exist.
  std::optional<std::string> fault_of_blob(const std::string& hash, const store::ReferencedBlob& blob,
                                           std::uint64_t& bytes) const {
    const auto path = path_of(DataFileKind::blob, hash);
    if (!store::is_real_file(path)) return std::nullopt;
    const store::Descriptor file(path, O_RDONLY);
    if (!file.ok() && errno == ENOENT) return std::nullopt;
    const auto stamp = store::file_stamp(file);
    // Not read: a file that has grown may have no end.
    if (stamp && blob.bytes && stamp->size != *blob.bytes)
      return "it has " + std::to_string(stamp->size) + " bytes, its record says " + std::to_string(*blob.bytes);
    const auto found = file.ok() ? store::hash_of(file, bytes) : std::nullopt;
    if (!found) return "it cannot be read: " + std::string(std::strerror(errno));
    if (*found != hash) return "its bytes have the SHA-256 " + *found;
    return "";
  }

  void check_blob(const std::string& hash, const store::ReferencedBlob& blob) {
    std::uint64_t bytes = 0;
    const auto fault = fault_of_blob(hash, blob, bytes);
    if (fault && fault->empty()) {
      ++report_.blobs;
      report_.blob_bytes += bytes;
      return;
    }
    auto words = users_in_words(blob.users);
    if (fault) words += ": " + *fault;
    suspects_.push_back({fault ? FaultKind::damaged_blob : FaultKind::missing_blob, hash, std::move(words)});
  }

  /// As fault_of_blob().
  std::optional<std::string> fault_of_recording(const std::string& id, const store::RecordingRecord& record,
                                                std::uint64_t& bytes) {
    const auto path = path_of(DataFileKind::recording, id);
    if (!store::is_real_file(path)) return std::nullopt;
    const auto opened = recordings::open_bytes(path);
    if (!opened && opened.error().code == ErrorCode::missing) return std::nullopt;
    if (!opened) return "it cannot be read: " + opened.error().message;
    bytes = (*opened)->size();
    const auto reader = recordings::RecordingReader::open(*opened, recordings::Check::everything);
    if (!reader) return (reader.error().where.empty() ? "" : reader.error().where + ": ") + reader.error().message;
    // A server writes the end of a running recording, or has been killed while it did; its next start cuts that off.
    if (record.state == store::RecordingState::recording) return "";
    if (reader->torn_bytes() > 0) return "byte " + std::to_string(reader->whole_bytes()) + ": " + reader->torn_reason();
    if (reader->frames() != record.frames)
      return "it has " + std::to_string(reader->frames()) + " frames, its record says " + std::to_string(record.frames);
    return "";
  }

  void check_recording(const std::string& id, const store::RecordingRecord& record) {
    std::uint64_t bytes = 0;
    const auto fault = fault_of_recording(id, record, bytes);
    if (fault && fault->empty()) {
      ++report_.recordings;
      report_.recording_bytes += bytes;
      return;
    }
    if (fault && record.state == store::RecordingState::broken) {
      report_.notes.push_back("the recording " + id + " was found damaged by an earlier start: " + *fault);
      return;
    }
    auto words = "of the stream " + record.stream;
    if (fault) words += ": " + *fault;
    suspects_.push_back({fault ? FaultKind::damaged_recording : FaultKind::missing_recording, id, std::move(words)});
  }

  /// Decides about the suspects with a newer reading of the database: what was removed or added since is no fault.
  Status judge() {
    if (suspects_.empty()) return Unit{};
    auto later = store::read_database(file_, store::Reading::records);
    if (!later) return later.error();
    report_.server_runs = report_.server_runs || is_server_running(data_);
    for (auto& suspect : suspects_)
      if (is_still_so(suspect, *later)) report(std::move(suspect));
    return Unit{};
  }

  bool is_still_so(const Fault& suspect, const DatabaseSnapshot& now) {
    std::uint64_t bytes = 0;
    const auto blob = now.blobs.find(suspect.name);
    const auto recording = now.recordings.find(suspect.name);
    switch (suspect.kind) {
      case FaultKind::missing_blob:
      case FaultKind::damaged_blob: {
        if (blob == now.blobs.end()) return false;
        const auto fault = fault_of_blob(suspect.name, blob->second, bytes);
        return !fault || !fault->empty();
      }
      case FaultKind::missing_recording:
      case FaultKind::damaged_recording: {
        if (recording == now.recordings.end()) return false;
        const auto fault = fault_of_recording(suspect.name, recording->second, bytes);
        return !fault || !fault->empty();
      }
      case FaultKind::unknown_blob:
        return blob == now.blobs.end() && store::is_real_file(path_of(DataFileKind::blob, suspect.name));
      case FaultKind::unknown_recording:
        return recording == now.recordings.end() && store::is_real_file(path_of(DataFileKind::recording, suspect.name));
      case FaultKind::damaged_database:
      case FaultKind::missing_row:
        break;
    }
    return true;
  }

  void report(Fault suspect) {
    const bool unknown = suspect.kind == FaultKind::unknown_blob || suspect.kind == FaultKind::unknown_recording;
    if (unknown && report_.server_runs) {
      const std::string what = suspect.kind == FaultKind::unknown_blob ? "blob " : "recording ";
      report_.notes.push_back("the database does not know the " + what + suspect.name +
                              " (yet, perhaps: the server runs)");
      return;
    }
    if (unknown) suspect.detail = "the next start of the server moves it to the trash";
    add(std::move(suspect));
  }

  const fs::path data_, file_;
  CheckReport report_;
  DatabaseSnapshot known_;
  std::vector<Fault> suspects_;
};

std::uint64_t move_files(const fs::path& data, store::Trash& trash, DataFileKind kind,
                         const std::unordered_set<std::string>& known, CheckReport& counts) {
  const auto done = store::reconcile(data, trash, kind, known);
  counts.moved_to_trash += done.moved;
  counts.put_back += done.put_back;
  return done.failed;
}

template <class Map>
std::unordered_set<std::string> names_of(const Map& map) {
  std::unordered_set<std::string> names;
  for (const auto& [name, ignored] : map) names.insert(name);
  return names;
}

}  // namespace

std::string_view to_string(FaultKind kind) { return kind_names[static_cast<std::size_t>(kind)]; }

Result<CheckReport> check_data(const fs::path& data) {
  if (!store::is_real_folder(data)) return Error{ErrorCode::missing, data.string(), "there is no such folder"};
  return Checker(data).run();
}

Result<CheckReport> repair_data(const fs::path& data) {
  if (!store::is_real_folder(data)) return Error{ErrorCode::missing, data.string(), "there is no such folder"};
  const auto lock = DataLock::take(data);
  if (!lock) return Error{ErrorCode::mismatch, data.string(), "a server works in this folder: stop it first"};
  const auto known = store::read_database(data / store::database_file_name, store::Reading::records);
  if (!known) return known.error();
  CheckReport counts;
  store::Trash trash(data, std::chrono::hours(24) * 7);
  const auto failed = move_files(data, trash, DataFileKind::blob, names_of(known->blobs), counts) +
                      move_files(data, trash, DataFileKind::recording, names_of(known->recordings), counts);
  if (auto synced = trash.sync(); !synced) return synced.error();
  if (failed > 0) return Error{ErrorCode::io, data.string(), std::to_string(failed) + " files could not be moved"};
  auto report = Checker(data).run();
  if (!report) return report;
  report->server_runs = false;  // the lock of this process
  report->moved_to_trash = counts.moved_to_trash;
  report->put_back = counts.put_back;
  return report;
}

std::string to_text(const CheckReport& report) {
  std::string text;
  for (const auto& fault : report.faults) {
    text.append(to_string(fault.kind)).append(fault.name.empty() ? "" : " " + fault.name);
    text.append(fault.detail.empty() ? "" : ": " + fault.detail).append("\n");
  }
  for (const auto& note : report.notes) text.append("note: ").append(note).append("\n");
  if (report.moved_to_trash + report.put_back > 0)
    text.append("repaired: " + std::to_string(report.moved_to_trash) + " files moved to the trash, " +
                std::to_string(report.put_back) + " put back from it\n");
  text.append(std::to_string(report.blobs) + " blobs (" + std::to_string(report.blob_bytes) + " bytes) and " +
              std::to_string(report.recordings) + " recordings (" + std::to_string(report.recording_bytes) +
              " bytes) are intact; " + std::to_string(report.faults.size()) +
              (report.faults.size() == 1 ? " fault\n" : " faults\n"));
  return text;
}

std::string to_json(const CheckReport& report) {
  nlohmann::ordered_json json;
  json["server_runs"] = report.server_runs;
  json["blobs"] = {{"intact", report.blobs}, {"bytes", report.blob_bytes}};
  json["recordings"] = {{"intact", report.recordings}, {"bytes", report.recording_bytes}};
  auto& faults = json["faults"] = nlohmann::ordered_json::array();
  for (const auto& fault : report.faults)
    faults.push_back({{"kind", to_string(fault.kind)}, {"name", fault.name}, {"detail", fault.detail}});
  json["notes"] = report.notes;
  json["repaired"] = {{"moved_to_trash", report.moved_to_trash}, {"put_back", report.put_back}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace semblante::upkeep
