#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/store/records.h"

namespace semblante::store {

/// The index of a part, and the role that a user gives it; empty: the guessed role again.
using RoleChange = std::pair<std::uint32_t, std::optional<std::string>>;

/// Facts about models: the results of imports, user settings, marked points and the models' own displacement sets. The
/// rules of Store (store.h) hold.
class ModelStore {
 public:
  virtual ~ModelStore() = default;

  /// Creates model, source artefact and import job in one transaction. False when the id is taken.
  virtual bool create_model(const ModelRecord& model, const ArtefactRecord& source, const JobRecord& job,
                            const std::optional<IdempotencyRecord>& key) = 0;
  virtual std::optional<ModelRecord> model(std::string_view id) = 0;
  /// In the order of creation, after the model `after` (empty: from the first). nullopt when `after` does not exist.
  virtual std::optional<std::vector<ModelRecord>> models(std::string_view after, std::size_t limit) = 0;
  virtual std::size_t model_count() = 0;
  /// False when the model does not exist or its revision is not `expected_revision`.
  virtual bool edit_model(std::string_view id, const std::optional<std::string>& name,
                          const std::vector<RoleChange>& roles, std::uint64_t expected_revision) = 0;
  /// Sets the user's wish for the frame, and the frame itself if no new import is needed; with `import` also sets the
  /// model to importing and creates that job. False like edit_model.
  virtual bool edit_frame(std::string_view id, const FrameWish& wish, const ModelFrame& frame,
                          const std::optional<JobRecord>& import, std::uint64_t expected_revision) = 0;
  /// Replaces sets of the library for this model only; a set without displacements restores that of the library. With
  /// `parametrization` also creates that job. False like edit_model.
  virtual bool edit_worn(std::string_view id, const std::vector<WornSet>& changes,
                         const std::optional<JobRecord>& parametrization, std::uint64_t expected_revision) = 0;
  /// The sets that replace those of the library in this model, with displacements, by slot name.
  virtual std::vector<WornSet> worn_sets(std::string_view model) = 0;
  /// Removes the model with all that belongs to it. nullopt when it does not exist, else the hashes that are no longer
  /// referred to.
  virtual std::optional<std::vector<std::string>> remove_model(std::string_view id) = 0;
  virtual std::vector<FeaturePointRecord> feature_points(std::string_view model) = 0;
  /// Replaces all points. False when the model does not exist or the revision of its points is another.
  bool put_feature_points(std::string_view model, const std::vector<FeaturePointRecord>& points,
                          std::uint64_t expected_revision) {
    return put_points_and_fapu(model, points, std::nullopt, expected_revision);
  }
  /// The same, and in the same transaction replaces all units given by hand, if `fapu` is not empty.
  virtual bool put_points_and_fapu(std::string_view model, const std::vector<FeaturePointRecord>& points,
                                   const std::optional<FapuByUser>& fapu, std::uint64_t expected_revision) = 0;
};

}  // namespace semblante::store
