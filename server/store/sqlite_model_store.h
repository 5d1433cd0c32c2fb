#pragma once

// Private to store/.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/store/model_store.h"
#include "server/store/sqlite_part.h"

namespace semblante::store {

class SqliteModelStore : public virtual ModelStore, private SqlitePart {
 public:
  using SqlitePart::SqlitePart;

  bool create_model(const ModelRecord& model, const ArtefactRecord& source, const JobRecord& job,
                    const std::optional<IdempotencyRecord>& key) override;
  std::optional<ModelRecord> model(std::string_view id) override;
  std::optional<std::vector<ModelRecord>> models(std::string_view after, std::size_t limit) override;
  std::size_t model_count() override;
  bool edit_model(std::string_view id, const std::optional<std::string>& name, const std::vector<RoleChange>& roles,
                  std::uint64_t expected_revision) override;
  bool edit_frame(std::string_view id, const FrameWish& wish, const ModelFrame& frame,
                  const std::optional<JobRecord>& import, std::uint64_t expected_revision) override;
  bool edit_worn(std::string_view id, const std::vector<WornSet>& changes,
                 const std::optional<JobRecord>& parametrization, std::uint64_t expected_revision) override;
  std::vector<WornSet> worn_sets(std::string_view model) override;
  std::optional<std::vector<std::string>> remove_model(std::string_view id) override;
  std::vector<FeaturePointRecord> feature_points(std::string_view model) override;
  bool put_points_and_fapu(std::string_view model, const std::vector<FeaturePointRecord>& points,
                           const std::optional<FapuByUser>& fapu, std::uint64_t expected_revision) override;
};

}  // namespace semblante::store
