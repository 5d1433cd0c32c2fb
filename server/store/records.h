#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/frame/frame_guess.h"
#include "server/settings/stream_settings.h"

namespace semblante::store {

/// A rotation, by rows.
using Turn = std::array<double, 9>;

/// What the import found out about a part, with the role a guess or a user gave it.
struct PartRecord {
  std::string name;
  std::string role;           ///< as part_role_names; of the last guess
  bool role_by_user = false;  ///< a user's role replaces the guess
  std::uint32_t vertices = 0, triangles = 0;
  std::array<double, 3> box_min{}, box_max{};

  bool operator==(const PartRecord&) const = default;
};

/// How much the fit doctor found; the findings are the artefact report.json.
struct FindingCounts {
  std::uint32_t errors = 0, warnings = 0, notes = 0;

  bool operator==(const FindingCounts&) const = default;
};

/// What a parametrization found out about how its model stands.
struct FrameUpdate {
  std::optional<ModelFrame> frame;
  std::optional<Turn> turn;  ///< from how it stood to how it stands now: boxes are new, and marked positions follow
  std::array<double, 3> box_min{}, box_max{};

  bool operator==(const FrameUpdate&) const = default;
};

enum class ModelState { importing, ready, parametrized, failed };
enum class JobState { queued, running, done, failed, cancelled };
inline constexpr std::size_t job_state_count = 5;

/// An immutable thing a model has, by name; the bytes are in the blob folder under the hash.
struct ArtefactRecord {
  std::string name;  ///< "source", "positions", "preview.glb", "mesh.drc", "weights", "rig.json", "face.glb",
                     ///< "image-0", "report.json"
  std::string sha256;
  std::uint64_t bytes = 0;
  std::string content_type;

  bool operator==(const ArtefactRecord&) const = default;
};

/// One level of detail of a package, 0 the full mesh; its artefacts are named by artefact_name().
struct LevelRecord {
  std::uint32_t vertices = 0, triangles = 0;  ///< as mesh.drc decodes

  bool operator==(const LevelRecord&) const = default;
};

/// The name under which an artefact of a level is kept: "mesh.drc", "lod1.mesh.drc".
std::string artefact_name(std::size_t lod, std::string_view name);

/// The package a parametrization made.
struct PackageRecord {
  std::string parametrization;  ///< id of the job
  std::string created;
  std::string metric, weights;
  int weight_bits = 12;
  std::vector<LevelRecord> levels;  ///< by lod; empty in a store of before there were any: the full mesh alone

  bool operator==(const PackageRecord&) const = default;
};

/// A morph target of the file, kept aside: its name, and how many vertices it moves.
struct MorphTargetRecord {
  std::string name;
  std::uint32_t vertices = 0;

  bool operator==(const MorphTargetRecord&) const = default;
};

/// A displacement set that clients made (core/extract/named_set.h).
struct SetRecord {
  std::string id, name;
  std::string kind = "expression";  ///< as set_kind_names
  std::uint64_t revision = 1;       ///< rises with every PUT
  std::string created, updated;
  std::string displacements;  ///< JSON, as displacements_to_json writes it
  std::string source;         ///< JSON of what it was taken from, or empty: made by hand

  bool operator==(const SetRecord&) const = default;
};

/// A set that a model wears in place of one of the library's: its own copy, so that nothing that happens to the set
/// later changes the face.
struct WornSet {
  std::string slot;  ///< name of the viseme or the expression
  std::string set, name;
  std::uint64_t revision = 1;
  std::string displacements;  ///< JSON; empty in ModelRecord, which only says what is worn

  bool operator==(const WornSet&) const = default;
};

struct ModelRecord {
  std::string id, name;
  ModelState state = ModelState::importing;
  std::string problem;           ///< JSON of the problem document, or empty
  std::string created, updated;  ///< RFC 3339, UTC
  std::uint64_t revision = 1;    ///< rises with every change of the model or its feature points
  std::string file_name, format;
  std::uint64_t source_bytes = 0;
  std::string source_sha256;
  std::uint32_t vertices = 0, triangles = 0;
  std::array<double, 3> box_min{}, box_max{};
  std::vector<PartRecord> parts;
  std::vector<std::string> warnings;
  std::optional<FindingCounts> findings;  ///< of the last import or parametrization; empty: never examined
  std::vector<MorphTargetRecord> morph_targets;
  std::optional<ModelFrame> frame;  ///< by which positions, boxes and package are turned; none before the import
  FrameWish frame_wish;             ///< what the user says of it
  std::uint32_t feature_point_count = 0;
  std::uint64_t feature_points_revision = 0;  ///< rises with every PUT; 0: never put
  std::optional<PackageRecord> package;
  std::vector<WornSet> worn;  ///< by slot name, without displacements

  bool operator==(const ModelRecord&) const = default;
};

/// How a point was proposed that nobody has placed or confirmed yet.
struct ProposalRecord {
  std::string method;           ///< as proposal_method_names; empty: not known
  std::string confidence;       ///< as confidence_names; empty: not known
  double expected_error = 0.0;  ///< in ES0; 0: not known
  std::string remark = {};      ///< what else makes it unsure, in words; mostly empty

  bool operator==(const ProposalRecord&) const = default;
};

/// One marked point as the user gave it: a vertex, a position, or both.
struct FeaturePointRecord {
  std::string id;  ///< "2.1"
  std::optional<std::uint32_t> vertex;
  std::optional<std::array<double, 3>> position;
  std::optional<ProposalRecord> proposal = std::nullopt;  ///< empty: placed

  bool operator==(const FeaturePointRecord&) const = default;
};

/// What jobs of all kinds have in common. What a job is asked and what came of it depend on its kind (server/jobs): the
/// store keeps both as JSON that it does not look into.
struct JobRecord {
  std::string id;
  std::string model;  ///< empty: it is of none
  std::string kind;   ///< a name in server/jobs
  JobState state = JobState::queued;
  double progress = 0.0;  ///< 0..1
  std::string stage;
  std::string created, updated;
  std::string problem;         ///< JSON of the problem document, or empty
  std::uint32_t attempts = 0;  ///< how often a worker began it
  std::string request = "{}";  ///< JSON object of what it is asked; never changes
  std::string result;          ///< JSON of what it has to say beside what it changed, or empty

  bool operator==(const JobRecord&) const = default;
};

struct StreamRecord {
  std::string id, created;
  settings::StreamSettings settings;

  bool operator==(const StreamRecord&) const = default;
};

enum class RecordingState {
  recording,
  finished,
  broken,  ///< its file is damaged, or gone: what can be read of it is what it is
};

/// A recording of a stream; the frames are in a file of the data folder under its id. While it runs, what it has grown
/// to is known by who records: durations and counts here are those of its end.
struct RecordingRecord {
  std::string id, stream, name, model, created;
  RecordingState state = RecordingState::recording;
  std::string ended;           ///< why: a word of server/recordings/recorder.h; empty while it runs
  std::uint64_t duration = 0;  ///< ms
  std::uint64_t frames = 0, lost = 0, bytes = 0;
  std::uint64_t epoch = 0;
  std::uint64_t media_time = 0;               ///< of the first frame
  std::optional<std::uint64_t> max_duration;  ///< ms, if it was asked to end by itself

  bool operator==(const RecordingRecord&) const = default;
};

/// Remembers under which key a creating request came, and what it made.
struct IdempotencyRecord {
  std::string key;
  std::string fingerprint;  ///< of method, path and body
  std::string resource;     ///< id of the job or stream that the request created

  bool operator==(const IdempotencyRecord&) const = default;
};

/// Which database this is, and how old.
struct DatabaseIdentity {
  std::string id;            ///< made with the database; a copy has the same
  std::uint64_t starts = 0;  ///< of servers with it; 0: none has worked with it yet

  bool operator==(const DatabaseIdentity&) const = default;
};

std::string_view to_string(ModelState state);
std::string_view to_string(JobState state);
std::string_view to_string(RecordingState state);
/// Stage of a job that does not run any more but for its cancellation. In the store it outlives the process: the next
/// start cancels such a job instead of taking it up.
inline constexpr std::string_view cancelling_stage = "cancelling";
inline bool is_final(JobState state) { return state != JobState::queued && state != JobState::running; }

/// The points after new proposals came: every placed point of `current` as it is, and the proposals for the others.
/// Earlier proposals are gone, so that what is proposed is always the last answer. In rising order of id.
std::vector<FeaturePointRecord> with_proposals(std::vector<FeaturePointRecord> current,
                                               const std::vector<FeaturePointRecord>& proposals);

/// Now, as RFC 3339 in UTC with milliseconds.
std::string timestamp_now();
/// A new id of 12 characters out of a-z and 2-7, from the system's random source: 60 bits.
std::string random_id();

}  // namespace semblante::store
