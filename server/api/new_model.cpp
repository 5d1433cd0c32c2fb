#include "server/api/new_model.h"

#include <shared_mutex>
#include <utility>

#include "server/jobs/job.h"

namespace semblante::api {

Result<NewModel> add_model(store::ModelStore& store, const store::BlobStore& blobs, const std::filesystem::path& file,
                           std::string id, std::string name, std::string file_name,
                           std::optional<store::IdempotencyRecord> key, const store::Origin& origin) {
  const std::shared_lock references(blobs.references());
  auto blob = blobs.adopt(file);
  if (!blob) return blob.error();
  NewModel made;
  auto& model = made.model;
  model.id = id.empty() ? store::random_id() : std::move(id);
  model.name = std::move(name);
  model.file_name = std::move(file_name);
  model.created = model.updated = store::timestamp_now();
  model.source_bytes = blob->bytes;
  model.source_sha256 = blob->sha256;
  model.owner = origin.owner;
  made.job = jobs::new_record(jobs::ImportJob{}, model.id, origin);
  if (key) key->resource = made.job.id;
  const store::ArtefactRecord source{"source", blob->sha256, blob->bytes, "application/octet-stream"};
  if (!store.create_model(model, source, made.job, key))
    return Error{ErrorCode::mismatch, "", "there is a model " + model.id + " already"};
  return made;
}

}  // namespace semblante::api
