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

/// A part by its index, and the role a user gives it; empty: back to the guess.
using RoleChange = std::pair<std::uint32_t, std::optional<std::string>>;

/// Facts about models: what an import found, what users say, what is marked and what is worn. The rules of Store
/// (store.h) hold.
class ModelStore {
 public:
  virtual ~ModelStore() = default;

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
  virtual std::vector<FeaturePointRecord> feature_points(std::string_view model) = 0;
  /// Replaces the whole set. False when the model is gone or the revision of its points is another.
  virtual bool put_feature_points(std::string_view model, const std::vector<FeaturePointRecord>& points,
                                  std::uint64_t expected_revision) = 0;
};

}  // namespace semblante::store
