#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/records.h"

namespace semblante::store {

/// The contents of the blob folder, and the records that refer to them. Artefacts are added and removed with models and
/// with the ends of jobs. The rules of Store (store.h) hold.
class ArtefactStore {
 public:
  virtual ~ArtefactStore() = default;

  virtual std::optional<ArtefactRecord> artefact(std::string_view model, std::string_view name) = 0;
  virtual std::vector<ArtefactRecord> artefacts(std::string_view model) = 0;
  /// By content, among the artefacts that clients may fetch (all but "source" and "positions").
  virtual std::optional<ArtefactRecord> public_artefact(std::string_view sha256) = 0;
  /// Bytes of all artefacts and of the files of speeches, each content counted once.
  virtual std::uint64_t artefact_bytes() = 0;
  /// Every hash that a record refers to: the blobs that a start expects and keeps.
  virtual std::vector<std::string> referenced_hashes() = 0;
  /// The records that refer to a hash: "model <id>", "speech <id>", "job <id>".
  virtual std::vector<std::string> users_of(std::string_view sha256) = 0;
};

}  // namespace semblante::store
