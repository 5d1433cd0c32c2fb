#pragma once

// Private to store/.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/artefact_store.h"
#include "server/store/sqlite_part.h"

namespace semblante::store {

class SqliteArtefactStore : public virtual ArtefactStore, private SqlitePart {
 public:
  using SqlitePart::SqlitePart;

  std::optional<ArtefactRecord> artefact(std::string_view model, std::string_view name) override;
  std::vector<ArtefactRecord> artefacts(std::string_view model) override;
  std::optional<ArtefactRecord> public_artefact(std::string_view sha256) override;
  std::uint64_t artefact_bytes() override;
  std::vector<std::string> referenced_hashes() override;
  std::vector<std::string> users_of(std::string_view sha256) override;
};

}  // namespace semblante::store
