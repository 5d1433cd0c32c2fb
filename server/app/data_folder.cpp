#include "server/app/data_folder.h"

#include <set>

#include "server/log/log.h"
#include "server/store/last_database.h"
#include "server/store/reconcile.h"

namespace semblante {
namespace {

using store::DataFileKind;
using store::Reconciled;

constexpr std::size_t most_named = 10;

std::string count_of(std::uint64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string grace_text(std::chrono::seconds grace) {
  if (grace.count() == 0) return "until the next start";
  constexpr std::int64_t day = 86400;
  const auto seconds = grace.count();
  return "for " + (seconds % day == 0 ? count_of(static_cast<std::uint64_t>(seconds / day), "day")
                                      : count_of(static_cast<std::uint64_t>(seconds), "second"));
}

/// What is unusual about the database; empty when it is the one last used in this folder.
std::string strangeness(const store::DatabaseIdentity& now, const std::optional<store::DatabaseIdentity>& last) {
  if (now.starts == 0) return "is new";
  if (!last) return {};  // written by a version without this file
  if (now.id != last->id) return "is not the one last used in this folder";
  if (now.starts < last->starts) return "is an older copy of the one last used in this folder";
  return {};
}

template <class Names>
std::string list_of(const Names& names) {
  std::string text;
  std::size_t number = 0;
  for (const auto& name : names) {
    if (number == most_named) return text + " and " + std::to_string(names.size() - most_named) + " more";
    text.append(number++ == 0 ? "" : ", ").append(name);
  }
  return text;
}

void report_missing(store::ArtefactStore& store, const Reconciled& blobs, const Reconciled& recordings) {
  if (!blobs.missing.empty()) {
    std::set<std::string> users;
    for (const auto& hash : blobs.missing)
      for (auto& user : store.users_of(hash)) users.insert(std::move(user));
    log::warning(count_of(blobs.missing.size(), "blob") + " that the database refers to " +
                 (blobs.missing.size() == 1 ? "is" : "are") + " neither in the data folder nor in its trash; of " +
                 list_of(users) + ": " + list_of(blobs.missing));
  }
  if (!recordings.missing.empty())
    log::warning(count_of(recordings.missing.size(), "recording") +
                 " of the database without a file in the data folder or its trash: " + list_of(recordings.missing));
}

void report_failures(const Reconciled& result, const std::string& what) {
  if (result.fault.empty()) return;
  log::warning(what + " could not be reconciled with the database (" + count_of(result.failed, "file") +
               " left where it was): " + result.fault);
}

void report_moved(const std::filesystem::path& data, const store::Trash& trash, const std::string& strange,
                  const Reconciled& blobs, const Reconciled& recordings) {
  const auto moved = blobs.moved + recordings.moved;
  if (moved == 0 && (strange.empty() || trash.counts().files == 0)) return;
  const auto what = count_of(blobs.moved, "blob") + " and " + count_of(recordings.moved, "recording") + " (" +
                    std::to_string(blobs.moved_bytes + recordings.moved_bytes) + " bytes)";
  if (strange.empty()) {
    log::info(what + " that the database does not know moved to " + trash.batch().string());
    return;
  }
  const auto database = data / store::database_file_name;
  std::string text = "THE DATABASE " + database.string() + " " + strange;
  if (moved > 0) text += " and does not know " + what + " of this data folder, moved to " + trash.batch().string();
  log::warning(text + ". The trash holds " + count_of(trash.counts().files, "file") + "; each stays there " +
               grace_text(trash.grace()) + " (--trash-grace)");
  log::warning(
      "To get them back: stop the server, put the right " + database.string() +
      " in its place (remove the -wal and -shm of this one), start again; what that one knows returns from the "
      "trash by itself");
}

/// Stores that this database is used in this folder now.
void count_start(const std::filesystem::path& data, store::DatabaseFacts& store) {
  try {
    if (const auto noted = write_last_database(data, store.count_start()); !noted)
      log::warning("the start cannot be recorded: " + noted.error().message);
  } catch (const std::exception& fault) {
    log::warning(std::string("the start cannot be recorded: ") + fault.what());
  }
}

}  // namespace

void keep_log_of_lost_database(const std::filesystem::path& data, store::Trash& trash) {
  // What is no file counts as having content: the store refuses it, with its name.
  const auto is_empty = [&](std::string_view name) {
    std::error_code error;
    if (!std::filesystem::exists(std::filesystem::symlink_status(data / name, error))) return true;
    return std::filesystem::is_regular_file(data / name, error) && std::filesystem::is_empty(data / name, error);
  };
  if (!is_empty(store::database_file_name) || is_empty(store::database_log_name)) return;
  if (const auto kept = trash.put(DataFileKind::database_log, store::database_log_name); !kept) {
    log::warning("the write-ahead log of a missing database cannot be kept: " + kept.error().message);
    return;
  }
  log::warning("there is no " + std::string(store::database_file_name) +
               " to its write-ahead log, which may have the newest " + "changes; moved to " +
               (trash.batch() / store::database_log_name).string() + ": put both back together, while no server runs");
}

void bring_files_in_line(const std::filesystem::path& data, store::Store& store, store::Trash& trash) {
  const auto strange = strangeness(store.identity(), store::read_last_database(data));
  const auto blobs = reconcile(data, trash, DataFileKind::blob, known_blobs(store));
  const auto recordings = reconcile(data, trash, DataFileKind::recording, known_recordings(store));
  if (const auto synced = trash.sync(); !synced) log::warning("the trash: " + synced.error().message);
  report_moved(data, trash, strange, blobs, recordings);
  if (blobs.put_back + recordings.put_back > 0)
    log::info(count_of(blobs.put_back, "blob") + " and " + count_of(recordings.put_back, "recording") +
              " that the database knows returned from the trash");
  report_missing(store, blobs, recordings);
  report_failures(blobs, "blobs");
  report_failures(recordings, "recordings");
  count_start(data, store);
}

}  // namespace semblante
