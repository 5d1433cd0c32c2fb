#include "server/app/sample_installer.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <shared_mutex>

#include "core/import/axes.h"
#include "core/import/feature_points_file.h"
#include "core/lod/decimate.h"
#include "protocol/hash/sha256.h"
#include "server/api/new_model.h"
#include "server/api/new_parametrization.h"
#include "server/app/serve_failure.h"
#include "server/log/log.h"

namespace semblante {
namespace {

std::string read_text(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  const bool is_folder = std::filesystem::is_directory(status);
  // A device may have no end, and a FIFO waits for a writer.
  const bool is_other = std::filesystem::is_other(status);
  std::ifstream stream;
  errno = 0;
  if (!is_other) stream.open(path, std::ios::binary);
  if (!stream.is_open() || is_folder)
    fail_serve("--sample: " + path.string() + " cannot be read: " +
               (is_folder  ? "it is a folder; name the file of a model in it"
                : is_other ? "it is no file"
                           : std::strerror(errno)));
  return {(std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>()};
}

std::vector<store::FeaturePointRecord> read_points(const std::filesystem::path& path) {
  auto file = parse_feature_points(read_text(path));
  if (!file) fail("serve: --sample: " + path.string(), file.error());
  change_axes(*file);
  std::vector<store::FeaturePointRecord> records;
  for (const auto& point : file->points) {
    store::FeaturePointRecord record{to_string(point.id), point.vertex, std::nullopt};
    if (point.position) record.position = {point.position->x, point.position->y, point.position->z};
    records.push_back(std::move(record));
  }
  return records;
}

}  // namespace

SampleInstaller::SampleInstaller(store::ModelStore& models, store::JobStore& jobs, store::BlobStore& blobs,
                                 store::PendingWrites& pending, jobs::JobQueue& queue, std::filesystem::path file)
    : models_(models), jobs_(jobs), blobs_(blobs), pending_(pending), queue_(queue), file_(std::move(file)) {
  if (file_.empty()) return;
  hash_ = sha256_hex(read_text(file_));
  points_ = read_points(std::filesystem::path(file_).replace_extension(".fps.json"));
}

SampleInstaller::~SampleInstaller() { pending_.release(this); }

void SampleInstaller::begin() {
  if (file_.empty()) return;
  pending_.write(this, "sample", "the next step of the sample head", [this] { take_next_step(); });
}

void SampleInstaller::take_next_step() {
  const auto model = models_.model(sample_model_id);
  if (!model || model->source_sha256 != hash_ || model->state == store::ModelState::failed) {
    import();
  } else if (model->state == store::ModelState::ready) {
    const auto job = jobs_.latest_job(sample_model_id, jobs::ParametrizeJob::kind_name);
    if (!job || store::is_final(job->state)) parametrize();
  }
}

void SampleInstaller::import() {
  if (models_.model(sample_model_id)) {  // another version of the program has another head
    queue_.cancel_all_of(sample_model_id);
    const std::unique_lock alone(blobs_.references());
    if (const auto orphans = models_.remove_model(sample_model_id))
      for (const auto& hash : *orphans) blobs_.remove(hash);
  }
  const auto copy = blobs_.temporary() / "sample";
  std::error_code error;
  std::filesystem::copy_file(file_, copy, std::filesystem::copy_options::overwrite_existing, error);
  store::throw_if_disk_full(copy, error.value());
  auto made = api::add_model(models_, blobs_, copy, std::string(sample_model_id), "Sample head",
                             file_.filename().string(), std::nullopt);
  if (!made) {
    log::error("the sample head cannot be installed: " + made.error().message);
    return;
  }
  queue_.enqueue(made->job);
}

void SampleInstaller::parametrize() {
  const auto model = models_.model(sample_model_id);
  if (!model) return;
  if (model->feature_point_count == 0) {
    for (const auto& point : points_) {
      if (!point.vertex || *point.vertex < model->vertices) continue;
      log::error("the sample head has no vertex for its feature point " + point.id);
      return;
    }
    models_.put_feature_points(sample_model_id, points_, model->feature_points_revision);
  }
  jobs::ParametrizeJob options;
  options.weights = "smooth";  // better weights for the first face that users see
  options.lods = default_budgets(model->vertices);
  queue_.enqueue(api::add_parametrization(jobs_, std::string(sample_model_id), options, std::nullopt));
}

void SampleInstaller::job_finished(const store::JobRecord& job) {
  if (file_.empty() || job.model != sample_model_id || job.state != store::JobState::done) return;
  if (job.kind == jobs::ImportJob::kind_name)
    begin();
  else
    log::info("the sample head is ready");
}

}  // namespace semblante
