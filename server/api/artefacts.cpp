#include "server/api/common.h"
#include "server/api/generated/handlers.h"
#include "server/api/levels.h"
#include "server/api/stored_file.h"
#include "server/http/conditional.h"
#include "server/http/content_coding.h"

namespace semblante::api {
http::Response file_response(Context& context, const http::Request& request, const store::ArtefactRecord& artefact,
                             std::string_view cache_control) {
  const auto path = context.blobs.whole(artefact.sha256, artefact.bytes);
  http::Response response;
  response.headers["Content-Type"] = artefact.content_type;
  response.headers["ETag"] = "\"sha256-" + artefact.sha256 + "\"";
  response.headers["Cache-Control"] = std::string(cache_control);
  response.body = http::FileBody{path, 0, artefact.bytes};
  // Text becomes a fifth of its size; meshes, weights and images are compressed already.
  const bool is_text = artefact.content_type == "application/json" && artefact.bytes <= http::max_gzip_bytes;
  if (is_text) http::vary_by(response, "Accept-Encoding");
  const bool packed = is_text && http::wants_coding(request, "gzip");
  if (packed) http::mark_coding(response, "gzip");
  response = http::apply_conditions(request, std::move(response));
  // A job may replace the artefact, and remove its file, before it is sent.
  if (auto* file = std::get_if<http::FileBody>(&response.body)) {
    file->open = std::make_shared<const http::OpenFile>(path);
    if (file->open->descriptor() < 0) {
      static_cast<void>(context.blobs.whole(artefact.sha256, artefact.bytes));  // throws if it is gone by now
      file->open = nullptr;                                                     // who sends it says why
    }
  }
  if (packed) http::gzip_body(response);
  return response;
}

namespace {

http::Response model_artefact(Context& context, const http::Request& request, const std::string& name) {
  const auto find = [&] {
    const auto model = model_of(context, request);
    const std::size_t level = model.package && is_of_package(name) ? level_of(request, *model.package) : 0;
    auto artefact = context.store.artefact(model.id, store::artefact_name(level, name));
    if (artefact) return std::move(*artefact);
    const bool of_import = name == "preview.glb" || name == "report.json";
    refuse("not-found", "the model has no " + name + (of_import ? ": it is not imported" : ": it is not parametrized"));
  };
  for (auto artefact = find();;) {
    try {
      // The content under this name changes with each parametrization, so clients must revalidate by the ETag.
      return file_response(context, request, artefact, "no-cache");
    } catch (const store::DamagedBlob&) {
      auto now = find();
      if (now.sha256 == artefact.sha256) throw;
      artefact = std::move(now);  // a job has replaced it since its record was read
    }
  }
}

}  // namespace

http::Response get_preview(Context& context, http::Request& request) {
  return model_artefact(context, request, "preview.glb");
}
http::Response get_mesh(Context& context, http::Request& request) {
  return model_artefact(context, request, "mesh.drc");
}
http::Response get_weights(Context& context, http::Request& request) {
  return model_artefact(context, request, "weights");
}
http::Response get_rig(Context& context, http::Request& request) {
  return model_artefact(context, request, "rig.json");
}
http::Response get_face(Context& context, http::Request& request) {
  return model_artefact(context, request, "face.glb");
}
http::Response get_report(Context& context, http::Request& request) {
  return model_artefact(context, request, "report.json");
}

http::Response get_artefact(Context& context, http::Request& request) {
  const auto& hash = request.params.at("sha256");
  const auto artefact = context.store.public_artefact(hash);
  if (!artefact) refuse("not-found", "there is no artefact " + hash);
  return file_response(context, request, *artefact, http::cache_forever);
}

}  // namespace semblante::api
