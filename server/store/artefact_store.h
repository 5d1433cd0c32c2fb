#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/records.h"

namespace semblante::store {

/// What is kept in the blob folder, and who refers to it. Artefacts come and go with models and ends of jobs. The rules
/// of Store (store.h) hold.
class ArtefactStore {
 public:
  virtual ~ArtefactStore() = default;

  virtual std::optional<ArtefactRecord> artefact(std::string_view model, std::string_view name) = 0;
  virtual std::vector<ArtefactRecord> artefacts(std::string_view model) = 0;
  /// By content, among those clients may fetch (all but "source" and "positions").
  virtual std::optional<ArtefactRecord> public_artefact(std::string_view sha256) = 0;
  /// Bytes of all artefacts, each content counted once.
  virtual std::uint64_t artefact_bytes() = 0;
  /// Every hash the facts refer to: blobs that a start must find or keep.
  virtual std::vector<std::string> referenced_hashes() = 0;
  /// Who refers to a hash: "model <id>", "job <id>".
  virtual std::vector<std::string> users_of(std::string_view sha256) = 0;
};

}  // namespace semblante::store
