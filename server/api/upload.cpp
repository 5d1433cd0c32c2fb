#include <cerrno>
#include <fstream>

#include <nlohmann/json.hpp>

#include "core/import/import.h"
#include "core/types/printable.h"
#include "protocol/hash/sha256.h"
#include "server/api/common.h"
#include "server/api/generated/handlers.h"
#include "server/api/mapped_file.h"
#include "server/api/new_model.h"
#include "server/api/quota.h"
#include "server/api/storage_problems.h"
#include "server/http/media_type.h"
#include "server/http/multipart.h"

namespace semblante::api {
namespace {

/// An uploaded file, sent as a body or in a form.
struct Upload {
  std::filesystem::path path;
  std::string file_name, name;
  std::shared_ptr<http::TemporaryFile> extracted;  ///< owns the file of a form's part
};

Upload take_form(const http::Request& request) {
  const auto& body = request.body_file->path();
  const MappedFile mapped(body);
  auto parts =
      http::parse_multipart(mapped.text(), http::parameter(request.header("Content-Type").value_or(""), "boundary"));
  if (!parts) refuse("malformed-request", "the form cannot be read: " + parts.error().message);
  Upload upload;
  const http::FormPart* file = nullptr;
  for (const auto& part : *parts) {
    if (part.name == "file") {
      if (file != nullptr) refuse("invalid-field", "the form has two parts \"file\"", "/file", Advice::send_all_files);
      file = &part;
    }
    if (part.name == "name" && !part.content.empty()) upload.name = checked_text(part.content, max_name_bytes, "/name");
  }
  if (file == nullptr) refuse("invalid-field", "the form has no part \"file\"", "/file");
  upload.file_name = clean_file_name(file->file_name);
  upload.extracted = std::make_shared<http::TemporaryFile>(body.string() + ".part");
  upload.path = upload.extracted->path();
  errno = 0;
  std::ofstream out(upload.path, std::ios::binary);
  out.write(file->content.data(), static_cast<std::streamsize>(file->content.size()));
  if (!out.flush()) store::throw_store_error(upload.path, errno);
  return upload;
}

Upload take_upload(const http::Request& request) {
  Upload upload;
  if (http::essence(request.header("Content-Type").value_or("")) == "multipart/form-data") {
    upload = take_form(request);
  } else {
    upload.path = request.body_file->path();
    upload.file_name = clean_file_name(http::file_name_of(request.header("Content-Disposition").value_or("")));
  }
  if (const auto name = request.query_value("filename")) upload.file_name = clean_file_name(*name);
  if (const auto name = request.query_value("name")) upload.name = checked_text(*name, max_name_bytes, "?name");
  if (upload.name.empty()) upload.name = std::filesystem::path(upload.file_name).stem().string();
  if (is_blank(upload.name)) upload.name = "Untitled";
  return upload;
}

http::Response accepted(Context& context, const store::ModelRecord& model, const store::JobRecord& job) {
  auto response = json_response(
      202, answer::NewModel{.model = represent(model, context.store.artefacts(model.id)), .job = represent(job)});
  response.headers["Location"] = "/v1/models/" + model.id;
  return response;
}

}  // namespace

http::Response create_model(Context& context, http::Request& request) {
  const auto upload = take_upload(request);
  std::string hash;
  {
    const MappedFile mapped(upload.path);
    if (mapped.bytes().empty()) refuse("empty-model", "the file is empty", "/file");
    if (const auto format = format_of(mapped.bytes(), upload.file_name); !format)
      refuse("unsupported-media-type", format.error().message, "/file", format.error().advice);
    hash = sha256_hex(mapped.text());
  }
  auto check = check_idempotency(context, request, hash + upload.name + upload.file_name);
  if (check.earlier) {
    const auto job = context.jobs.find(*check.earlier);
    const auto model = job ? context.store.model(job->model) : std::nullopt;
    if (model) return accepted(context, *model, *job);
    refuse("conflict", "what this Idempotency-Key created has been removed");
  }
  if (context.store.model_count() >= context.config.limits.max_models)
    refuse("limit-exceeded",
           "the server has reached its limit of " + std::to_string(context.config.limits.max_models) + " models");
  refuse_unless_room(context.jobs);
  const auto turn =
      take_quota(context, request, {.bytes = std::filesystem::file_size(upload.path), .models = 1, .jobs = 1});
  auto made = add_model(context.store, context.blobs, upload.path, {}, upload.name, upload.file_name, check.record,
                        origin_of(request));
  if (!made) refuse_unkept(made.error());
  context.jobs.enqueue(made->job);
  return accepted(context, made->model, made->job);
}

}  // namespace semblante::api
