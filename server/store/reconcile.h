#pragma once

#include <cstdint>
#include <string>
#include <unordered_set>
#include <vector>

#include "server/store/artefact_store.h"
#include "server/store/recording_store.h"
#include "server/store/trash.h"

namespace semblante::store {

/// The result of reconcile() for the files of one kind.
struct Reconciled {
  std::uint64_t moved = 0, moved_bytes = 0;  ///< into the trash: the database does not know them
  std::uint64_t put_back = 0;                ///< out of the trash: the database knows them
  std::uint64_t failed = 0;                  ///< could not be moved and were left in place
  std::string fault;                         ///< of the first failure
  std::vector<std::string> missing;          ///< the database knows them, but they do not exist
};

/// To be called at a start, before anything reads or adds files. Moves every file of the kind that is not `known` into
/// the trash, and moves those that are known and missing back from it. `data` is the folder of the trash.
Reconciled reconcile(const std::filesystem::path& data, Trash& trash, DataFileKind kind,
                     const std::unordered_set<std::string>& known);

/// The names of the blobs that a database knows: every hash it refers to.
std::unordered_set<std::string> known_blobs(ArtefactStore& store);
/// The names of the recordings that a database knows.
std::unordered_set<std::string> known_recordings(RecordingStore& store);

}  // namespace semblante::store
