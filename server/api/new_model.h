#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/types/result.h"
#include "server/store/blob_store.h"
#include "server/store/model_store.h"

namespace semblante::api {

struct NewModel {
  store::ModelRecord model;
  store::JobRecord job;
};

/// Stores a new model, its file and its import job, durably. `id` empty: a random one. The job is not queued yet.
/// Errors: io.
Result<NewModel> add_model(store::ModelStore& store, const store::BlobStore& blobs, const std::filesystem::path& file,
                           std::string id, std::string name, std::string file_name,
                           std::optional<store::IdempotencyRecord> key, const store::Origin& origin = {});

}  // namespace semblante::api
