// Values that no statement of this program writes, in a database whose pages and types are right.

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "server/store/database_snapshot.h"
#include "server/store/sqlite.h"
#include "server/store/store_error.h"
#include "tests/unit/store/store_fixture.h"

namespace semblante::store {
namespace {

using ::testing::HasSubstr;

class DamagedValues : public StoreTest {
 protected:
  DamagedValues() {
    import(add("m"));
    store_->put_feature_points("m", {{"2.1", 3, std::nullopt, std::nullopt}}, 0);
    StreamRecord stream;
    stream.id = "s";
    stream.settings.viseme_share = 0.5;
    store_->create_stream(stream, std::nullopt);
    RecordingRecord recording;
    recording.id = "r";
    recording.stream = "s";
    store_->create_recording(recording, std::nullopt);
    SetRecord set;
    set.id = "e";
    set.displacements = "{}";
    store_->create_set(set, std::nullopt);
    SpeechRecord speech;
    speech.id = "p";
    speech.request = "{}";
    store_->create_speech(speech, std::nullopt);
    store_->add_token({"t", "", "read", "", "", "", 1, ""});
    add("waits");
  }
};

struct DamagedValue {
  const char* sql;
  std::function<void(Store&)> read;
  const char* words;
};

TEST_F(DamagedValues, AreFaultsOfTheDatabase_NamedByColumnAndRow) {
  const auto models = [](Store& store) { (void)store.models("", 10); };
  const auto jobs = [](Store& store) { (void)store.unfinished_jobs(); };
  const auto streams = [](Store& store) { (void)store.streams(); };
  const auto recordings = [](Store& store) { (void)store.recordings("", "", 10); };
  const DamagedValue damages[] = {
      {"UPDATE models SET state = 4 WHERE id = 'm'", models, "`state` of `m` is 4, not a whole number from 0 to 3"},
      {"UPDATE models SET state = 2147483648", models, "`state` of `m` is 2147483648"},
      {"UPDATE models SET state = -1", models, "`state` of `m` is -1"},
      {"UPDATE models SET revision = 9223372036854775807", models, "`revision` of `m` is 9223372036854775807"},
      {"UPDATE models SET vertices = 4294967296", models, "`vertices` of `m` is 4294967296"},
      {"UPDATE models SET problem = '{'", models, "`problem` of `m` is {, not JSON"},
      {"UPDATE feature_points SET vertex = -1", [](Store& store) { (void)store.feature_points("m"); },
       "`vertex` of `2.1` is -1"},
      {"UPDATE jobs SET state = 1, progress = 1e999", jobs, "`progress` of `job-m` is Inf, not a finite number"},
      {"UPDATE jobs SET attempts = -1", jobs, "`attempts` of `job-waits` is -1"},
      {"UPDATE jobs SET request = 'x'", jobs, "`request` of `job-waits` is x, not JSON"},
      {"UPDATE streams SET viseme_share = 1e999", streams, "`viseme_share` of `s` is Inf"},
      {"UPDATE streams SET viseme_share = 2", streams, "no request has given the stream `s` its viseme_share"},
      {"UPDATE streams SET quantizer_scale = 3", streams, "no request has given the stream `s` its quantizer_scale"},
      {"UPDATE streams SET batch_interval = 5000", streams, "no request has given the stream `s` its batch_interval"},
      {"UPDATE streams SET batch_interval = -1", streams, "`batch_interval` of `s` is -1"},
      {"UPDATE recordings SET state = 3", recordings, "`state` of `r` is 3"},
      {"UPDATE recordings SET media_time = 9007199254740992", recordings, "`media_time` of `r` is 9007199254740992"},
      {"UPDATE displacement_sets SET displacements = 'x'", [](Store& store) { (void)store.sets("", 10); },
       "`displacements` of `e` is x"},
      {"UPDATE speeches SET warnings = '[1]'", [](Store& store) { (void)store.speeches("", 10); },
       "`warnings` of `p` is [1], not a list of texts"},
      {"UPDATE tokens SET expires = -1", [](Store& store) { (void)store.tokens(); }, "`expires` of `t` is -1"},
      {"UPDATE artefacts SET bytes = -1", [](Store& store) { (void)store.artefact("m", "source"); },
       "`bytes` of `source` is -1"},
  };
  const auto file = folder_ / "facts.sqlite", whole = folder_ / "whole.sqlite";
  store_.reset();
  std::filesystem::copy_file(file, whole);
  for (const auto& damage : damages) {
    SCOPED_TRACE(damage.sql);
    std::filesystem::copy_file(whole, file, std::filesystem::copy_options::overwrite_existing);
    Database(file.string()).execute(damage.sql);
    reopen();
    try {
      damage.read(*store_);
      ADD_FAILURE() << "it is taken";
    } catch (const DamagedDatabase& fault) {
      EXPECT_THAT(fault.what(), HasSubstr(damage.words));
    }
    store_.reset();
  }
}

TEST_F(DamagedValues, SumsBeyondAnyDisk_AreFaultsToo) {
  Database((folder_ / "facts.sqlite").string()).execute("UPDATE artefacts SET bytes = 9223372036854775807");
  EXPECT_THROW((void)store_->artefact_bytes(), DamagedDatabase);
  EXPECT_THROW((void)store_->usage_of(""), DamagedDatabase);
}

TEST_F(DamagedValues, AreFoundByACheck) {
  const auto file = folder_ / "facts.sqlite";
  for (const char* sql : {"UPDATE models SET state = 9", "UPDATE streams SET viseme_share = 1e999",
                          "UPDATE jobs SET attempts = -1", "UPDATE displacement_sets SET revision = -1"})
    Database(file.string()).execute(sql);
  const auto found = read_database(file, Reading::everything);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_THAT(found->damage,
              ::testing::ElementsAre(HasSubstr("`state` of `m`"), HasSubstr("`attempts` of `job-"),
                                     HasSubstr("`viseme_share` of `s`"), HasSubstr("`revision` of `e`")));
}

}  // namespace
}  // namespace semblante::store
