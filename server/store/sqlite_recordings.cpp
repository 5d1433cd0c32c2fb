#include "server/store/sqlite_recordings.h"

#include <string>

namespace semblante::store {
namespace {

constexpr const char* columns =
    "SELECT id, stream, name, model, created, state, ended, duration, frames, lost, bytes, epoch, media_time, "
    "max_duration, owner, sound_packets FROM recordings ";

RecordingRecord read_recording(const Statement& row) {
  RecordingRecord recording;
  recording.id = row.text(0);
  recording.stream = row.text(1);
  recording.name = row.text(2);
  recording.model = row.text(3);
  recording.created = row.text(4);
  recording.state = row.one_of(RecordingState::broken, 5);
  recording.ended = row.text(6);
  recording.duration = row.whole(7);
  recording.frames = row.whole(8);
  recording.lost = row.whole(9);
  recording.bytes = row.whole(10);
  recording.epoch = row.whole(11);
  recording.media_time = row.whole(12);
  if (!row.is_null(13)) recording.max_duration = row.whole(13);
  recording.owner = row.text(14);
  recording.sound_packets = row.is_null(15) ? std::nullopt : std::optional(row.whole(15));
  return recording;
}

}  // namespace

void insert_recording(Database& db, const RecordingRecord& r) {
  Statement(db, "INSERT INTO recordings VALUES(NULL,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
      .bind(r.id, r.stream, r.name, r.model, r.created, static_cast<int>(r.state), r.ended, r.duration, r.frames,
            r.lost, r.bytes, r.epoch, r.media_time, r.max_duration, r.owner, r.sound_packets)
      .run();
}

std::optional<RecordingRecord> find_recording(Database& db, std::string_view id) {
  Statement statement(db, std::string(columns) + "WHERE id = ?");
  statement.bind(id);
  if (!statement.step()) return std::nullopt;
  return read_recording(statement);
}

std::optional<RecordingRecord> find_newest_recording(Database& db, std::string_view stream) {
  Statement statement(db, std::string(columns) + "WHERE stream = ? ORDER BY number DESC LIMIT 1");
  statement.bind(stream);
  if (!statement.step()) return std::nullopt;
  return read_recording(statement);
}

std::optional<std::vector<RecordingRecord>> list_recordings(Database& db, std::string_view stream,
                                                            std::string_view after, std::size_t limit) {
  std::int64_t number = 0;
  if (!after.empty()) {
    Statement statement(db, "SELECT number FROM recordings WHERE id = ?");
    statement.bind(after);
    if (!statement.step()) return std::nullopt;
    number = statement.integer(0);
  }
  std::vector<RecordingRecord> list;
  Statement statement(db, std::string(columns) + "WHERE number > ? AND (? = '' OR stream = ?) ORDER BY number LIMIT ?");
  statement.bind(number, stream, stream, static_cast<std::uint64_t>(limit));
  while (statement.step()) list.push_back(read_recording(statement));
  return list;
}

void write_recording(Database& db, const RecordingRecord& r) {
  Statement(
      db,
      "UPDATE recordings SET state = ?, ended = ?, duration = ?, frames = ?, lost = ?, bytes = ?, media_time = ?, "
      "sound_packets = ? WHERE id = ?")
      .bind(static_cast<int>(r.state), r.ended, r.duration, r.frames, r.lost, r.bytes, r.media_time, r.sound_packets,
            r.id)
      .run();
}

}  // namespace semblante::store
