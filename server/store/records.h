#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/frame/frame_guess.h"
#include "server/settings/stream_settings.h"

namespace semblante::store {

/// A rotation, by rows.
using Turn = std::array<double, 9>;

/// The facts of a part from the import, with its role, guessed or set by a user.
struct PartRecord {
  std::string name;
  std::string role;           ///< as part_role_names; of the last guess
  bool role_by_user = false;  ///< a user's role replaces the guess
  std::uint32_t vertices = 0, triangles = 0;
  std::array<double, 3> box_min{}, box_max{};
  std::uint32_t index = 0;  ///< among all parts of the model

  bool operator==(const PartRecord&) const = default;
};

/// Parts that are kept of a model. A head with hair cards or loose triangles may have thousands; the others keep the
/// roles that are guessed for them.
inline constexpr std::size_t max_part_records = 512;

/// The parts with the most vertices, at most `most`, by index.
std::vector<PartRecord> largest_parts(std::vector<PartRecord> parts, std::size_t most);

/// Counts of the fit doctor's findings; the findings themselves are the artefact report.json.
struct FindingCounts {
  std::uint32_t errors = 0, warnings = 0, notes = 0;

  bool operator==(const FindingCounts&) const = default;
};

/// What a parametrization found out about the frame of its model.
struct FrameUpdate {
  std::optional<ModelFrame> frame;
  std::optional<Turn> turn;  ///< from the old to the new orientation; turns marked positions too
  std::array<double, 3> box_min{}, box_max{};

  bool operator==(const FrameUpdate&) const = default;
};

enum class ModelState { importing, ready, parametrized, failed };
enum class JobState { queued, running, done, failed, cancelled };
inline constexpr std::size_t job_state_count = 5;

/// An immutable file of a model, by name; its bytes are in the blob folder under their hash.
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

/// The stored name of an artefact of a level: "mesh.drc", "lod1.mesh.drc".
std::string artefact_name(std::size_t lod, std::string_view name);

/// The package that a parametrization produced.
struct PackageRecord {
  std::string parametrization;  ///< id of the job
  std::string created;
  std::string metric, weights;
  int weight_bits = 12;
  std::vector<LevelRecord> levels;  ///< by lod; empty in stores from before levels existed: only the full mesh

  bool operator==(const PackageRecord&) const = default;
};

/// A morph target of the file: its name, and how many vertices it moves.
struct MorphTargetRecord {
  std::string name;
  std::uint32_t vertices = 0;

  bool operator==(const MorphTargetRecord&) const = default;
};

/// A displacement set that clients made (core/extract/named_set.h).
struct SetRecord {
  std::string id, name;
  std::string kind = "expression";  ///< one of set_kind_names
  std::uint64_t revision = 1;       ///< rises with every PUT
  std::string created, updated;
  std::string displacements;  ///< JSON, written by displacements_to_json
  std::string source;         ///< JSON of the source of an extraction; empty: made by hand
  std::string owner = {};     ///< see Origin; never changes

  bool operator==(const SetRecord&) const = default;
};

/// A set that a model uses in place of one of the library's: a copy, so that later changes of the set do not change the
/// face.
struct WornSet {
  std::string slot;  ///< name of the viseme or the expression
  std::string set, name;
  std::uint64_t revision = 1;
  std::string displacements;  ///< JSON; empty in ModelRecord, which has only the names

  bool operator==(const WornSet&) const = default;
};

/// Lengths of units given by hand, by name: model units, not divided by 1024.
using FapuByUser = std::map<std::string, double>;

/// Whose request made a record, and which request.
struct Origin {
  std::string owner = {};    ///< id of the token; empty: a request without one, or the server itself
  std::string request = {};  ///< id of the request; empty: the server itself

  bool operator==(const Origin&) const = default;
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
  std::uint32_t part_count = 0;   ///< of all parts, also those that are not in `parts`
  std::vector<PartRecord> parts;  ///< by index; at most max_part_records, those with the most vertices
  std::vector<std::string> warnings;
  std::optional<FindingCounts> findings;  ///< of the last import or parametrization; empty: never examined
  std::vector<MorphTargetRecord> morph_targets;
  std::optional<ModelFrame> frame;  ///< the frame of positions, boxes and package; empty before the import
  FrameWish frame_wish;             ///< the user's settings for it
  std::uint32_t feature_point_count = 0;
  std::uint64_t feature_points_revision = 0;  ///< rises with every PUT; 0: never put
  FapuByUser fapu = {};                       ///< set together with the feature points
  std::optional<PackageRecord> package;
  std::vector<WornSet> worn;  ///< by slot name, without displacements
  std::string owner = {};     ///< see Origin; never changes

  bool operator==(const ModelRecord&) const = default;
};

/// How a point was proposed that no user has placed or confirmed yet.
struct ProposalRecord {
  std::string method;           ///< one of proposal_method_names; empty: not known
  std::string confidence;       ///< one of confidence_names; empty: not known
  double expected_error = 0.0;  ///< in ES0; 0: not known
  std::string remark = {};      ///< further reasons for doubt, as text; mostly empty

  bool operator==(const ProposalRecord&) const = default;
};

/// One marked point as given by the user: a vertex, a position, or both.
struct FeaturePointRecord {
  std::string id;  ///< "2.1"
  std::optional<std::uint32_t> vertex;
  std::optional<std::array<double, 3>> position;
  std::optional<ProposalRecord> proposal = std::nullopt;  ///< empty: placed

  bool operator==(const FeaturePointRecord&) const = default;
};

/// A token by which a client proves what it may do; the rules are in server/access.
struct TokenRecord {
  std::string id, name;
  std::string scope;                    ///< name of a scope
  std::string stream, model;            ///< of these only; empty: of all
  std::string created;                  ///< RFC 3339, UTC
  std::optional<std::int64_t> expires;  ///< seconds since 1970, UTC; empty: never
  std::string secret_hash;

  bool operator==(const TokenRecord&) const = default;
};

/// The members that jobs of all kinds have. Request and result depend on the kind of a job (server/jobs): the store
/// keeps both as JSON and does not parse it.
struct JobRecord {
  std::string id;
  std::string model;  ///< empty: the job has no model
  std::string kind;   ///< name of a kind in server/jobs
  JobState state = JobState::queued;
  double progress = 0.0;  ///< 0..1
  std::string stage;
  std::string created, updated;
  std::string problem;         ///< JSON of the problem document, or empty
  std::uint32_t attempts = 0;  ///< number of times a worker started it
  std::string request = "{}";  ///< JSON object; never changes
  std::string result;          ///< JSON of results other than stored changes, or empty
  Origin origin = {};          ///< never changes

  bool operator==(const JobRecord&) const = default;
};

struct StreamRecord {
  std::string id, created;
  settings::StreamSettings settings;
  std::string owner = {};  ///< see Origin; never changes

  bool operator==(const StreamRecord&) const = default;
};

enum class RecordingState {
  recording,
  finished,
  broken,  ///< its file is damaged or missing: only the readable part of it exists
};

/// A recording of a stream; the frames are in a file of the data folder under its id. Durations and counts are those of
/// its end; while it runs, only the recorder knows them.
struct RecordingRecord {
  std::string id, stream, name, model, created;
  RecordingState state = RecordingState::recording;
  std::string ended;           ///< the reason, one of those in server/recordings/recorder.h; empty while it runs
  std::uint64_t duration = 0;  ///< ms
  std::uint64_t frames = 0, lost = 0, bytes = 0;
  std::uint64_t epoch = 0;
  std::uint64_t media_time = 0;               ///< of the first frame
  std::optional<std::uint64_t> max_duration;  ///< ms; the recording ends by itself after it
  std::string owner = {};                     ///< see Origin; never changes
  /// nullopt: of a server that did not count them
  std::optional<std::uint64_t> sound_packets = 0;

  bool operator==(const RecordingRecord&) const = default;
};

/// A text as a face says it (server/voice/speech_maker.h): what was asked for, and its files as blobs.
struct SpeechRecord {
  std::string id, created;
  std::string request;         ///< JSON object: the body of the request
  std::string text;            ///< what is said, without marks
  std::string voice;           ///< what made the sound
  std::uint64_t duration = 0;  ///< ms
  std::vector<std::string> warnings = {};
  std::vector<ArtefactRecord> files = {};  ///< by name; see speech_file_names
  std::string owner = {};                  ///< see Origin; never changes

  bool operator==(const SpeechRecord&) const = default;
};

/// The idempotency key of a creating request, and what the request created.
struct IdempotencyRecord {
  std::string key;
  std::string fingerprint;  ///< hash of method, path and body
  std::string resource;     ///< id of the job or stream that the request created

  bool operator==(const IdempotencyRecord&) const = default;
};

/// The identity of a database, and the number of its starts.
struct DatabaseIdentity {
  std::string id;            ///< random, generated with the database; copies have the same
  std::uint64_t starts = 0;  ///< of servers with this database; 0: never used

  bool operator==(const DatabaseIdentity&) const = default;
};

std::string_view to_string(ModelState state);
std::string_view to_string(JobState state);
std::string_view to_string(RecordingState state);
/// Stage of a job that is being cancelled. It is stored, so that the next start cancels such a job instead of
/// continuing it.
inline constexpr std::string_view cancelling_stage = "cancelling";
inline bool is_final(JobState state) { return state != JobState::queued && state != JobState::running; }

/// Merges new proposals into the points: every placed point of `current` unchanged, and the new proposals for the
/// others. Earlier proposals are dropped, so that all proposals are from one job. In rising order of id.
std::vector<FeaturePointRecord> with_proposals(std::vector<FeaturePointRecord> current,
                                               const std::vector<FeaturePointRecord>& proposals);

/// Now, as RFC 3339 in UTC with milliseconds; the beginning of 1970 by a clock that is set before.
std::string timestamp_now();
/// The same form, of seconds since 1970.
std::string timestamp_of(std::int64_t seconds);
/// A new random id of 12 characters out of a-z and 2-7 (60 bits), from the system's random source.
std::string random_id();

}  // namespace semblante::store
