#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/records.h"

namespace semblante::store {

/// Jobs. The end of a job and the changes it makes are one transaction. The rules of Store (store.h) hold.
class JobStore {
 public:
  virtual ~JobStore() = default;

  /// `files` are hashes of blobs that belong to the job until it ends.
  virtual void create_job(const JobRecord& job, const std::vector<std::string>& files,
                          const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::optional<JobRecord> job(std::string_view id) = 0;
  /// Queued or running, oldest first: the jobs that a restart continues.
  virtual std::vector<JobRecord> unfinished_jobs() = 0;
  virtual std::optional<JobRecord> latest_job(std::string_view model, std::string_view kind) = 0;
  /// State, progress, stage, problem, attempts and result. Does nothing when the job does not exist.
  virtual void update_job(const JobRecord& job) = 0;
  /// The end of an import: job, facts of the model and its artefacts in one transaction. Artefacts of an earlier import
  /// are removed, and so is the package; the user's roles are kept, and marked positions are turned by `turn`, if
  /// given. Returns the hashes that are no longer referred to; nullopt when the model does not exist.
  virtual std::optional<std::vector<std::string>> finish_import(const JobRecord& job, const ModelRecord& facts,
                                                                const std::vector<ArtefactRecord>& artefacts,
                                                                const std::optional<Turn>& turn) = 0;
  /// The end of a parametrization: replaces the package, and artefacts of the import that have the same names; `parts`
  /// has the final guesses of roles, `frame` what the points showed. Returns the hashes that are no longer referred to;
  /// nullopt when the model does not exist.
  virtual std::optional<std::vector<std::string>> finish_parametrization(
      const JobRecord& job, const PackageRecord& package, const std::vector<PartRecord>& parts,
      const std::vector<std::string>& warnings, const std::optional<FindingCounts>& findings,
      const std::vector<ArtefactRecord>& artefacts, const FrameUpdate& frame) = 0;
  /// The end of a proposal: job and points (see with_proposals) in one transaction, even when the points have changed
  /// since the job began. False when the model does not exist.
  virtual bool finish_proposal(const JobRecord& job, const std::vector<FeaturePointRecord>& proposals) = 0;
  /// The end of a job that changes nothing else. Returns the hashes of the job's files that are no longer referred to.
  virtual std::vector<std::string> finish_job(const JobRecord& job) = 0;
  /// The end of an import without a result. The first import of a model makes the model failed; a model that was
  /// imported before gets its earlier state back. Returns hashes like finish_job.
  virtual std::vector<std::string> finish_failed_import(const JobRecord& job) = 0;
  /// The end of an extraction: job and set in one transaction. Returns hashes like finish_job.
  virtual std::vector<std::string> finish_extraction(const JobRecord& job, const SetRecord& set) = 0;
  /// Sets the stage of a job that has not ended to `cancelling_stage`. False when it has ended or does not exist.
  virtual bool request_cancel(std::string_view job) = 0;
};

}  // namespace semblante::store
