#include "server/store/records.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <stdexcept>

#include <sys/random.h>

#include "core/types/feature_point_id.h"

namespace semblante::store {
namespace {

/// RFC 3339, UTC, of milliseconds since 1970.
std::string timestamp(std::int64_t milliseconds) {
  const auto seconds = static_cast<std::time_t>(milliseconds / 1000);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 40> text{};
  const auto used = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  std::snprintf(text.data() + used, text.size() - used, ".%03dZ", static_cast<int>(milliseconds % 1000));
  return text.data();
}

}  // namespace

std::string_view to_string(ModelState state) {
  static constexpr std::array<std::string_view, 4> names = {"importing", "ready", "parametrized", "failed"};
  return names[static_cast<std::size_t>(state)];
}

std::vector<PartRecord> largest_parts(std::vector<PartRecord> parts, std::size_t most) {
  if (parts.size() <= most) return parts;
  // Equally large ones by index, so that an import and a parametrization of one model keep the same.
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return a.vertices != b.vertices ? a.vertices > b.vertices : a.index < b.index;
  });
  parts.resize(most);
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.index < b.index; });
  return parts;
}

std::vector<FeaturePointRecord> with_proposals(std::vector<FeaturePointRecord> current,
                                               const std::vector<FeaturePointRecord>& proposals) {
  std::erase_if(current, [](const FeaturePointRecord& point) { return point.proposal.has_value(); });
  const std::size_t placed = current.size();
  for (const auto& proposal : proposals) {
    const auto end = current.begin() + static_cast<std::ptrdiff_t>(placed);
    if (std::none_of(current.begin(), end, [&](const auto& point) { return point.id == proposal.id; }))
      current.push_back(proposal);
  }
  std::sort(current.begin(), current.end(),
            [](const auto& a, const auto& b) { return parse_feature_point(a.id) < parse_feature_point(b.id); });
  return current;
}

std::string_view to_string(JobState state) {
  static constexpr std::array<std::string_view, job_state_count> names = {"queued", "running", "done", "failed",
                                                                          "cancelled"};
  return names[static_cast<std::size_t>(state)];
}

std::string_view to_string(RecordingState state) {
  static constexpr std::array<std::string_view, 3> names = {"recording", "finished", "broken"};
  return names[static_cast<std::size_t>(state)];
}

std::string artefact_name(std::size_t lod, std::string_view name) {
  return lod == 0 ? std::string(name) : "lod" + std::to_string(lod) + "." + std::string(name);
}

std::string timestamp_now() {
  const auto since = std::chrono::system_clock::now().time_since_epoch();
  return timestamp(std::max<std::int64_t>(0, std::chrono::duration_cast<std::chrono::milliseconds>(since).count()));
}

std::string timestamp_of(std::int64_t seconds) { return timestamp(seconds * 1000); }

std::string random_id() {
  constexpr std::string_view alphabet = "abcdefghijklmnopqrstuvwxyz234567";
  std::array<unsigned char, 12> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::runtime_error("the system has no random numbers");
  std::string id;
  for (const auto byte : bytes) id.push_back(alphabet[byte % alphabet.size()]);
  return id;
}

}  // namespace semblante::store
