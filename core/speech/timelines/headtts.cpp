#include <cstddef>
#include <string>

#include "core/speech/timelines/formats.h"
#include "core/speech/timelines/timeline_json.h"

namespace semblante {

void read_headtts(std::string_view file, TimelineBuilder& builder) {
  read_object(file, builder, [&](const JsonCursor& root) {
    // A message of its WebSocket has the members in "data".
    const auto data = root.optional_member("data");
    const JsonCursor& from = data ? *data : root;
    const auto columns = [&](const char* texts, const char* times, const char* durations, const auto& take) {
      const JsonCursor text = from.member(texts), time = from.member(times), duration = from.member(durations);
      const std::size_t size = text.size();
      if (from.failed()) return;
      if (time.size() != size || duration.size() != size)
        return text.fail(ErrorCode::mismatch, "must be as many as the times and durations");
      for (std::size_t i = 0; i < size && !from.failed() && !builder.failed(); ++i) {
        const double begin = time.element(i).number(0.0, most_timeline_ms);
        take(text.element(i).text(most_text_bytes), begin, begin + duration.element(i).number(0.0, most_timeline_ms),
             text.element(i).pointer());
      }
    };
    columns("visemes", "vtimes", "vdurations",
            [&](const std::string& symbol, double begin, double end, const auto& at) {
              builder.sound(symbol, begin, end, at);
            });
    if (!from.failed() && from.has("words"))
      columns("words", "wtimes", "wdurations", [&](const std::string& text, double begin, double end, const auto& at) {
        builder.word(begin, text, at);
        if (!builder.failed() && end <= most_timeline_ms) builder.reach(end);
      });
  });
}

}  // namespace semblante
