#include "server/store/reconcile.h"

#include <algorithm>
#include <iterator>

namespace semblante::store {
namespace {

constexpr std::size_t page = 200;

void note_failure(Reconciled& result, std::uint64_t files, const Error& error) {
  result.failed += files;
  if (result.fault.empty()) result.fault = error.message;
}

}  // namespace

Reconciled reconcile(const std::filesystem::path& data, Trash& trash, DataFileKind kind,
                     const std::unordered_set<std::string>& known) {
  Reconciled result;
  auto missing = known;
  const auto files = list_data_files(data, kind);
  if (!files) {  // files that cannot be listed are neither unknown nor missing
    note_failure(result, 0, files.error());
    return result;
  }
  for (const auto& file : *files) {
    if (missing.erase(file.name) > 0) continue;
    if (const auto moved = trash.put(kind, file.name); !moved) {
      note_failure(result, 1, moved.error());
      continue;
    }
    ++result.moved;
    result.moved_bytes += file.bytes;
  }
  for (const auto& name : missing) {
    const auto found = trash.put_back(kind, name);
    if (!found) note_failure(result, 1, found.error());
    if (found && *found)
      ++result.put_back;
    else if (!is_real_file(data / data_file_path(kind, name)))  // not listed behind a linked folder
      result.missing.push_back(name);
  }
  std::sort(result.missing.begin(), result.missing.end());
  return result;
}

std::unordered_set<std::string> known_blobs(ArtefactStore& store) {
  auto hashes = store.referenced_hashes();
  return {std::make_move_iterator(hashes.begin()), std::make_move_iterator(hashes.end())};
}

std::unordered_set<std::string> known_recordings(RecordingStore& store) {
  std::unordered_set<std::string> names;
  std::string after;
  while (true) {
    const auto records = store.recordings("", after, page);
    if (!records || records->empty()) return names;
    for (const auto& record : *records) names.insert(record.id);
    after = records->back().id;
  }
}

}  // namespace semblante::store
