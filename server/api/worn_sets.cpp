#include <nlohmann/json.hpp>

#include "core/expressions/library.h"
#include "core/extract/set_file.h"
#include "core/json/json_pointer.h"
#include "server/api/common.h"
#include "server/api/sets.h"

namespace semblante::api {
namespace {

/// The kind of set for a slot; none for "sil" and "none", which are always at rest.
std::optional<SetKind> kind_of_slot(std::string_view slot) {
  const auto built_in = find_built_in(slot);
  if (!built_in || slot == viseme_library().front().name || slot == expression_library().front().name)
    return std::nullopt;
  return built_in->kind;
}

store::WornSet worn_from_json(Context& context, const std::string& slot, const JsonBody& value) {
  const auto pointer = std::string("/expressions/").append(pointer_segment(slot));
  const auto kind = kind_of_slot(slot);
  if (!kind) refuse("invalid-field", "there is no viseme or expression of this name to replace", pointer);
  store::WornSet worn;
  worn.slot = slot;
  if (value.is_null()) return worn;
  if (!value.is_string()) refuse("invalid-field", "it must be the id of a set, or null", pointer);
  const auto set = context.store.set(value.get<std::string>());
  if (!set) refuse("invalid-field", "there is no set of this id", pointer);
  if (set->kind != to_string(*kind))
    refuse("invalid-field",
           "this set is of the kind " + set->kind + ", \"" + slot + "\" is a " + std::string(to_string(*kind)),
           pointer);
  worn.set = set->id;
  worn.name = set->name;
  worn.revision = set->revision;
  worn.displacements = set->displacements;
  return worn;
}

}  // namespace

std::vector<store::WornSet> worn_from_json(Context& context, const JsonBody& changes) {
  if (!changes.is_object())
    refuse("invalid-field", "expressions is an object of visemes and expressions", "/expressions");
  std::vector<store::WornSet> worn;
  for (const auto& [slot, value] : changes.items()) worn.push_back(worn_from_json(context, slot, value));
  return worn;
}

std::optional<store::JobRecord> make_package_again(Context& context, const store::ModelRecord& model) {
  // A running parametrization may have started with the earlier sets: requests it again with the same options.
  const auto latest = context.store.latest_job(model.id, jobs::ParametrizeJob::kind_name);
  if (latest && !store::is_final(latest->state)) {
    if (const auto asked = jobs::read_job_as<jobs::ParametrizeJob>(*latest)) return jobs::new_record(*asked, model.id);
  }
  if (!model.package) return std::nullopt;
  if (const auto before = context.store.job(model.package->parametrization)) {
    if (const auto asked = jobs::read_job_as<jobs::ParametrizeJob>(*before)) return jobs::new_record(*asked, model.id);
  }
  jobs::ParametrizeJob again;  // the job was removed: what the package's record tells
  again.metric = model.package->metric;
  again.weights = model.package->weights;
  again.weight_bits = model.package->weight_bits;
  return jobs::new_record(again, model.id);
}

}  // namespace semblante::api
