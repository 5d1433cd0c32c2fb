#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/store/records.h"
#include "server/store/store_error.h"

namespace semblante::store {

/// A part by its index, and the role a user gives it; empty: back to the guess.
using RoleChange = std::pair<std::uint32_t, std::optional<std::string>>;

/// Facts about models, jobs and streams. Every call that changes something returns after the change is durable: it
/// survives the end of the process and of the machine. Calls may come from any thread but never from an I/O thread:
/// they wait for the disk. A disk that is full or fails throws DiskFull or another StoreError: nothing was changed.
class Store {
 public:
  virtual ~Store() = default;

  // ---- models
  /// Creates model, source artefact and import job in one step. False when the id is taken.
  virtual bool create_model(const ModelRecord& model, const ArtefactRecord& source, const JobRecord& job,
                            const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::optional<ModelRecord> model(std::string_view id) = 0;
  /// In the order of creation, after the model `after` (empty: from the first). nullopt when `after` is not there.
  virtual std::optional<std::vector<ModelRecord>> models(std::string_view after, std::size_t limit) = 0;
  virtual std::size_t model_count() = 0;
  /// False when the model is gone, or `expected_revision` is not its revision any more.
  virtual bool edit_model(std::string_view id, const std::optional<std::string>& name,
                          const std::vector<RoleChange>& roles, std::uint64_t expected_revision) = 0;
  /// Sets what the user says of the frame, and the frame itself where that needs no work; with `import` also takes the
  /// model back to importing and creates that job. False as edit_model.
  virtual bool edit_frame(std::string_view id, const FrameWish& wish, const ModelFrame& frame,
                          const std::optional<JobRecord>& import, std::uint64_t expected_revision) = 0;
  /// Puts sets into slots of the library for this model alone; one without displacements gives the slot back. With
  /// `parametrization` also creates that job. False as edit_model.
  virtual bool edit_worn(std::string_view id, const std::vector<WornSet>& changes,
                         const std::optional<JobRecord>& parametrization, std::uint64_t expected_revision) = 0;
  /// What a model wears in place of the library's sets, with displacements, by slot name.
  virtual std::vector<WornSet> worn_sets(std::string_view model) = 0;
  /// Removes the model with everything it has. nullopt when there is none, else the hashes no one refers to any more.
  virtual std::optional<std::vector<std::string>> remove_model(std::string_view id) = 0;

  // ---- feature points
  virtual std::vector<FeaturePointRecord> feature_points(std::string_view model) = 0;
  /// Replaces the whole set. False when the model is gone or the revision of its points is another.
  virtual bool put_feature_points(std::string_view model, const std::vector<FeaturePointRecord>& points,
                                  std::uint64_t expected_revision) = 0;

  // ---- artefacts
  virtual std::optional<ArtefactRecord> artefact(std::string_view model, std::string_view name) = 0;
  virtual std::vector<ArtefactRecord> artefacts(std::string_view model) = 0;
  /// By content hash, among the artefacts that clients may fetch (all except "source" and "positions").
  virtual std::optional<ArtefactRecord> public_artefact(std::string_view sha256) = 0;
  /// Bytes of all artefacts, each content counted once.
  virtual std::uint64_t artefact_bytes() = 0;
  /// All hashes referenced by the database: the blobs that the server must keep.
  virtual std::vector<std::string> referenced_hashes() = 0;
  /// The users of a hash: "model <id>", "job <id>".
  virtual std::vector<std::string> users_of(std::string_view sha256) = 0;

  // ---- jobs
  virtual void create_job(const JobRecord& job, const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::optional<JobRecord> job(std::string_view id) = 0;
  /// Queued or running jobs, oldest first, which a restart resumes.
  virtual std::vector<JobRecord> unfinished_jobs() = 0;
  virtual std::optional<JobRecord> latest_job(std::string_view model, JobKind kind) = 0;
  /// Updates state, progress, stage, problem and attempts. Does nothing for a deleted job.
  virtual void update_job(const JobRecord& job) = 0;
  /// Ends an import: stores job, facts of the model and its artefacts in one transaction. Removes the results of an
  /// earlier import, including a package; keeps the user's roles and rotates marked positions by `turn`, if given.
  /// Returns the hashes without remaining references; nullopt when the model is deleted.
  virtual std::optional<std::vector<std::string>> finish_import(const JobRecord& job, const ModelRecord& facts,
                                                                const std::vector<ArtefactRecord>& artefacts,
                                                                const std::optional<Turn>& turn) = 0;
  /// Ends a parametrization in one transaction: replaces an earlier package and the artefacts of the
  /// import with the same names; stores the final roles and the frame found by the points. Returns the hashes without
  /// remaining references; nullopt when the model is deleted.
  virtual std::optional<std::vector<std::string>> finish_parametrization(
      const JobRecord& job, const PackageRecord& package, const std::vector<PartRecord>& parts,
      const std::vector<std::string>& warnings, const std::optional<FindingCounts>& findings,
      const std::vector<ArtefactRecord>& artefacts, const FrameUpdate& frame) = 0;
  /// Ends a proposal: stores job and points in one transaction, merged with the current points (see with_proposals).
  /// False when the model is deleted.
  virtual bool finish_proposal(const JobRecord& job, const std::vector<FeaturePointRecord>& proposals) = 0;
  /// Ends a job without a result. If it was the model's first import, the model is marked as failed; a model that was
  /// imported before returns to its previous state.
  /// Returns the hashes of the job's files without remaining references.
  virtual std::vector<std::string> finish_without_result(const JobRecord& job) = 0;
  /// Ends an extraction: stores job and set in one transaction. Returns hashes like finish_without_result.
  virtual std::vector<std::string> finish_extraction(const JobRecord& job, const SetRecord& set) = 0;
  /// Sets the stage of a job to `cancelling_stage`. False when the job has ended or is deleted.
  virtual bool request_cancel(std::string_view job) = 0;

  // ---- displacement sets
  virtual void create_set(const SetRecord& set, const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::optional<SetRecord> set(std::string_view id) = 0;
  /// As models().
  virtual std::optional<std::vector<SetRecord>> sets(std::string_view after, std::size_t limit) = 0;
  virtual std::size_t set_count() = 0;
  /// Name, kind and displacements. False when the set is gone, or `set.revision` is not its revision any more.
  virtual bool put_set(const SetRecord& set) = 0;
  /// False when there is none. Models that wear it keep their copy.
  virtual bool remove_set(std::string_view id) = 0;

  // ---- streams
  /// False when the id is taken.
  virtual bool create_stream(const StreamRecord& stream, const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::vector<StreamRecord> streams() = 0;
  virtual bool remove_stream(std::string_view id) = 0;

  // ---- recordings
  virtual void create_recording(const RecordingRecord& recording, const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::optional<RecordingRecord> recording(std::string_view id) = 0;
  virtual std::optional<RecordingRecord> newest_recording(std::string_view stream) = 0;
  /// As models(); of one stream, or of all where it is empty.
  virtual std::optional<std::vector<RecordingRecord>> recordings(std::string_view stream, std::string_view after,
                                                                 std::size_t limit) = 0;
  virtual std::size_t recording_count() = 0;
  /// How it ended: state, reason, and what it has grown to. Nothing happens to one that is gone.
  virtual void finish_recording(const RecordingRecord& recording) = 0;
  virtual bool remove_recording(std::string_view id) = 0;

  virtual std::optional<IdempotencyRecord> idempotency(std::string_view key) = 0;

  virtual DatabaseIdentity identity() = 0;
  /// One start more; the identity from now on.
  virtual DatabaseIdentity count_start() = 0;

  /// A cheap question to the disk, for /readyz.
  virtual bool healthy() = 0;
  /// A commit that changes nothing; throws as one that does.
  virtual void check_writable() = 0;
};

}  // namespace semblante::store
