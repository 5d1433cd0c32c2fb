#pragma once

// Private to store/.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/job_store.h"
#include "server/store/sqlite_part.h"

namespace semblante::store {

class SqliteJobStore : public virtual JobStore, private SqlitePart {
 public:
  using SqlitePart::SqlitePart;

  void create_job(const JobRecord& job, const std::vector<std::string>& files,
                  const std::optional<IdempotencyRecord>& key) override;
  std::optional<JobRecord> job(std::string_view id) override;
  std::vector<JobRecord> unfinished_jobs() override;
  std::optional<JobRecord> latest_job(std::string_view model, std::string_view kind) override;
  void update_job(const JobRecord& job) override;
  std::optional<std::vector<std::string>> finish_import(const JobRecord& job, const ModelRecord& facts,
                                                        const std::vector<ArtefactRecord>& artefacts,
                                                        const std::optional<Turn>& turn) override;
  std::optional<std::vector<std::string>> finish_parametrization(const JobRecord& job, const PackageRecord& package,
                                                                 const std::vector<PartRecord>& parts,
                                                                 const std::vector<std::string>& warnings,
                                                                 const std::optional<FindingCounts>& findings,
                                                                 const std::vector<ArtefactRecord>& artefacts,
                                                                 const FrameUpdate& frame) override;
  bool finish_proposal(const JobRecord& job, const std::vector<FeaturePointRecord>& proposals) override;
  std::vector<std::string> finish_job(const JobRecord& job) override;
  std::vector<std::string> finish_failed_import(const JobRecord& job) override;
  std::vector<std::string> finish_extraction(const JobRecord& job, const SetRecord& set) override;
  bool request_cancel(std::string_view job) override;
};

}  // namespace semblante::store
