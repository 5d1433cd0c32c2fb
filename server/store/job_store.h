#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/store/records.h"

namespace semblante::store {

/// Jobs, and their ends with what they change, each in one step. The rules of Store (store.h) hold.
class JobStore {
 public:
  virtual ~JobStore() = default;

  /// `files` are hashes of blobs that are the job's own until it ends.
  virtual void create_job(const JobRecord& job, const std::vector<std::string>& files,
                          const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::optional<JobRecord> job(std::string_view id) = 0;
  /// Queued or running, oldest first: what a restart takes up again.
  virtual std::vector<JobRecord> unfinished_jobs() = 0;
  virtual std::optional<JobRecord> latest_job(std::string_view model, std::string_view kind) = 0;
  /// State, progress, stage, problem, attempts and result. Nothing happens to a job that is gone.
  virtual void update_job(const JobRecord& job) = 0;
  /// The end of an import: job, facts of the model, and its artefacts, in one step. What an import before it made goes,
  /// a package too; the user's roles stay, and marked positions follow `turn`, if there is one. Hashes no one refers to
  /// any more are returned; nullopt when the model is gone.
  virtual std::optional<std::vector<std::string>> finish_import(const JobRecord& job, const ModelRecord& facts,
                                                                const std::vector<ArtefactRecord>& artefacts,
                                                                const std::optional<Turn>& turn) = 0;
  /// The end of a parametrization, likewise: replaces the package that was there and artefacts of
  /// the import of the same names; roles are the final guesses, and what the points showed of the frame is kept. Hashes
  /// no one refers to any more are returned; nullopt when the model is gone.
  virtual std::optional<std::vector<std::string>> finish_parametrization(
      const JobRecord& job, const PackageRecord& package, const std::vector<PartRecord>& parts,
      const std::vector<std::string>& warnings, const std::optional<FindingCounts>& findings,
      const std::vector<ArtefactRecord>& artefacts, const FrameUpdate& frame) = 0;
  /// The end of a proposal: job and points (see with_proposals) in one step, whatever became of the points since it
  /// began. False when the model is gone.
  virtual bool finish_proposal(const JobRecord& job, const std::vector<FeaturePointRecord>& proposals) = 0;
  /// The end of a job that changes nothing else: hashes no one refers to any more, of the job's files, are returned.
  virtual std::vector<std::string> finish_job(const JobRecord& job) = 0;
  /// The end of an import without a result: one that is the first of its model fails the model too; a model that was
  /// imported before is again what it was. Hashes as finish_job.
  virtual std::vector<std::string> finish_failed_import(const JobRecord& job) = 0;
  /// The end of an extraction: job and set in one step. Hashes as finish_job.
  virtual std::vector<std::string> finish_extraction(const JobRecord& job, const SetRecord& set) = 0;
  /// Sets the stage of a job that has not ended to `cancelling_stage`. False when it has ended or is gone.
  virtual bool request_cancel(std::string_view job) = 0;
};

}  // namespace semblante::store
