#include "core/speech/voice_timeline.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/json/json_cursor.h"
#include "core/json/json_tree.h"
#include "core/speech/characters.h"
#include "core/speech/viseme_symbols.h"
#include "core/types/decimal.h"
#include "core/types/printable.h"

namespace semblante {
namespace {

constexpr double most_ms = max_speech_seconds * 1000.0;
constexpr double ms_per_s = 1000.0, ticks_per_ms = 10'000.0;
constexpr double least_gap_ms = 20.0;  ///< a shorter one between two sounds is none
constexpr std::size_t most_sounds_a_second =
    60;                                       ///< three times as many as anybody says; more would take long to animate
constexpr double last_sound_ms = 200.0;       ///< of a sound whose end nobody says
constexpr double past_the_sound_ms = 1000.0;  ///< that an event may come
constexpr double same_time_ms = 0.1;          ///< what rounding does to a time
constexpr std::size_t most_symbol_bytes = 32, most_text_bytes = 2000;
constexpr JsonLimits limits = {.max_bytes = max_timeline_bytes, .max_depth = 8, .max_values = 8 * max_timeline_events};

/// Control characters of a text become spaces.
std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte < 0x20 || byte == 0x7F;
      },
      ' ');
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? std::string() : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Takes the events of a file, with every check that all formats have in common. The first error is kept.
class Builder {
 public:
  explicit Builder(TimelineFormat format, const VisemeSymbols* symbols) : symbols_(symbols) {
    timeline_.format = format;
    timeline_.of_visemes = symbols != nullptr;
  }

  /// A viseme of the system, or a phoneme with its marks of stress. `end`: unknown without.
  void sound(std::string_view symbol, double time, std::optional<double> end, const std::string& where) {
    SpokenPhoneme phoneme;
    phoneme.time = time;
    if (symbols_ != nullptr) {
      const VisemeSymbol* const found = symbols_->find(symbol);
      if (found == nullptr)
        return fail(ErrorCode::out_of_range, where,
                    "there is no \"" + printable(symbol) + "\" among the symbols of " + std::string(symbols_->system));
      phoneme.symbol = found->ipa;
    } else {
      constexpr std::string_view primary = "ˈ", secondary = "ˌ";
      if (symbol.starts_with(primary)) phoneme.stress = Stress::primary;
      if (symbol.starts_with(secondary)) phoneme.stress = Stress::secondary;
      if (phoneme.stress != Stress::none) symbol.remove_prefix(primary.size());
      if (symbol.size() > most_symbol_bytes) return fail(ErrorCode::too_large, where, "a phoneme is too long");
      phoneme.symbol = symbol == "sil" || symbol == "_" ? "" : printable(symbol);
    }
    stressed_sound(std::move(phoneme), end, where);
  }
  void stressed_sound(SpokenPhoneme phoneme, std::optional<double> end, const std::string& where) {
    if (!take_time(phoneme.time, timeline_.phonemes, where)) return;
    if (end && !(*end >= phoneme.time && *end <= most_ms))
      return fail(ErrorCode::out_of_range, where, "ends before it begins, or after the longest speech");
    const auto& sounds = timeline_.phonemes;
    if (sounds.size() >= most_sounds_a_second &&
        phoneme.time - sounds[sounds.size() - most_sounds_a_second].time < ms_per_s)
      return fail(ErrorCode::too_large, where,
                  "there are more than " + std::to_string(most_sounds_a_second) + " sounds within a second");
    if (sound_end_ && phoneme.time - *sound_end_ >= least_gap_ms) timeline_.phonemes.push_back({*sound_end_, ""});
    sound_end_ = end;
    reach(end.value_or(phoneme.time));
    timeline_.phonemes.push_back(std::move(phoneme));
  }
  void word(double time, std::string text, const std::string& where) {
    if (take_time(time, timeline_.words, where)) timeline_.words.push_back({time, on_one_line(std::move(text))});
  }
  void sentence(double time, std::string text, const std::string& where) {
    if (take_time(time, timeline_.sentences, where))
      timeline_.sentences.push_back({time, on_one_line(std::move(text))});
  }
  /// Of a file that has the whole text.
  void whole_text(std::string text) {
    std::replace_if(
        text.begin(), text.end(),
        [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t') || c == 0x7F; }, ' ');
    timeline_.text = std::move(text);
  }
  void placed_word(double time, std::string text, std::size_t first, const std::string& where) {
    if (take_time(time, timeline_.words, where)) timeline_.words.push_back({time, std::move(text), first});
  }
  void placed_sentence(double time, std::size_t first, const std::string& where) {
    if (take_time(time, timeline_.sentences, where)) timeline_.sentences.push_back({time, "", first});
  }
  void mark(double time, std::string_view name, const std::string& where) {
    if (take_time(time, timeline_.marks, where)) timeline_.marks.push_back({time, printable(name)});
  }
  /// The sound goes on to here.
  void reach(double ms) { timeline_.end = std::max(timeline_.end, ms); }

  void fail(ErrorCode code, std::string where, std::string message) {
    if (!fault_) fault_ = Error{code, std::move(where), std::move(message)};
  }
  [[nodiscard]] bool failed() const { return fault_.has_value(); }

  Result<VoiceTimeline> finish() && {
    if (fault_) return *std::move(fault_);
    if (timeline_.phonemes.empty()) return Error{ErrorCode::empty, "", "the timeline has no sounds"};
    const bool fills_the_sound = !timeline_.text.empty() && sound_end_ && *sound_end_ >= timeline_.end;
    if (sound_end_ && !fills_the_sound && !timeline_.phonemes.back().symbol.empty())
      timeline_.phonemes.push_back({*sound_end_, ""});
    if (!timeline_.phonemes.back().symbol.empty() && timeline_.phonemes.back().time >= timeline_.end)
      timeline_.end = timeline_.phonemes.back().time + last_sound_ms;
    return std::move(timeline_);
  }

 private:
  /// Whether the time is good for the next event of the list.
  template <class Event>
  bool take_time(double time, const std::vector<Event>& events, const std::string& where) {
    if (failed()) return false;
    if (++events_ > max_timeline_events) {
      fail(ErrorCode::too_large, where, "there are more than " + std::to_string(max_timeline_events) + " events");
    } else if (!(time >= 0.0 && time <= most_ms)) {
      fail(ErrorCode::out_of_range, where,
           "a time must be within " + std::to_string(static_cast<int>(max_speech_seconds)) + " s");
    } else if (!events.empty() && time < events.back().time) {
      fail(ErrorCode::out_of_range, where, "times must not decrease");
    }
    reach(failed() ? 0.0 : time);
    return !failed();
  }

  VoiceTimeline timeline_;
  const VisemeSymbols* symbols_;
  std::optional<double> sound_end_;  ///< of the last sound, where it is known
  std::optional<Error> fault_;
  std::size_t events_ = 0;
};

// ---- lines

/// Calls `take(line, where)` for each line that is not blank.
template <class Take>
void each_line(std::string_view file, const Builder& builder, Take take) {
  std::size_t number = 0;
  while (!file.empty() && !builder.failed()) {
    const std::size_t end = std::min(file.find('\n'), file.size());
    std::string_view line = file.substr(0, end);
    file.remove_prefix(std::min(end + 1, file.size()));
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find_first_not_of(" \t") != std::string_view::npos) take(line, "line " + std::to_string(number));
  }
}

std::vector<std::string_view> columns_of(std::string_view line) {
  std::vector<std::string_view> columns;
  for (;;) {
    const std::size_t tab = line.find('\t');
    columns.push_back(line.substr(0, tab));
    if (tab == std::string_view::npos) return columns;
    line.remove_prefix(tab + 1);
  }
}

/// ms of a number of seconds; NaN, which no check accepts, for anything else.
double seconds(std::string_view text) { return ms_per_s * read_double(text).value_or(std::nan("")); }

void read_table(std::string_view file, std::size_t width, Builder& builder) {
  each_line(file, builder, [&](std::string_view line, const std::string& where) {
    const auto columns = columns_of(line);
    if (columns.size() != width)
      return builder.fail(ErrorCode::malformed, where, "must have " + std::to_string(width) + " columns between tabs");
    std::optional<double> end;
    if (width == 3) end = seconds(columns[1]);
    builder.sound(columns.back(), seconds(columns[0]), end, where);
  });
}

/// The number after `name` and blanks, in any case of letters: "Audio offset: 850ms".
std::optional<double> number_after(std::string_view line, std::string_view name) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  const auto* const at =
      std::search(line.begin(), line.end(), name.begin(), name.end(), [&](char a, char b) { return lower(a) == b; });
  if (at == line.end()) return std::nullopt;
  std::string_view rest = line.substr(static_cast<std::size_t>(at - line.begin()) + name.size());
  rest.remove_prefix(std::min(rest.find_first_not_of(": "), rest.size()));
  std::size_t size = std::min(rest.find_first_not_of("0123456789."), rest.size());
  while (size > 0 && rest[size - 1] == '.') --size;  // the end of a sentence
  return read_double(rest.substr(0, size));
}

void read_printed_azure(std::string_view file, Builder& builder) {
  each_line(file, builder, [&](std::string_view line, const std::string& where) {
    if (line.starts_with("…")) return;  // as the documentation leaves lines out
    const auto viseme = number_after(line, "viseme id"), offset = number_after(line, "audio offset");
    if (!viseme || !offset)
      return builder.fail(ErrorCode::malformed, where, "must have a \"Viseme ID\" and an \"Audio offset\"");
    builder.sound(shortest_fixed_text(*viseme), *offset, {}, where);
  });
}

// ---- JSON

/// A document, or objects a line; each with its place.
template <class Take>
void each_value(std::string_view file, Builder& builder, Take take) {
  const auto read = [&](std::string_view text, const std::string& where, bool whole) {
    const auto tree = read_json_tree(text, limits);
    if (!tree)
      return builder.fail(tree.error().code, where + tree.error().where, "cannot be read: " + tree.error().message);
    JsonCursor::Report report;
    const JsonCursor root(tree->root(), where, report);
    if (!whole) {
      take(root);
    } else {
      for (const JsonCursor& element : root.elements(1, max_timeline_events)) {
        take(element);
        if (report || builder.failed()) break;
      }
    }
    if (report) builder.fail(report->code, report->where, report->message);
  };
  if (file.find_first_not_of(" \t\r\n") != std::string_view::npos && file[file.find_first_not_of(" \t\r\n")] == '[')
    return read(file, "", true);
  each_line(file, builder, [&](std::string_view line, const std::string& where) { read(line, where, false); });
}

/// The member by one of its names: as it is documented, or as a language's binding writes it.
std::optional<JsonCursor> member_of(const JsonCursor& object, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (auto found = object.optional_member(name)) return found;
  return std::nullopt;
}

void read_azure(std::string_view file, Builder& builder) {
  if (file.find('{') == std::string_view::npos) return read_printed_azure(file, builder);
  each_value(file, builder, [&](const JsonCursor& event) {
    event.must_be_object();
    const auto offset = member_of(event, {"audioOffset", "audio_offset", "AudioOffset", "privAudioOffset"});
    const double time =
        (offset ? *offset : event.member("audioOffset")).number(0.0, most_ms * ticks_per_ms) / ticks_per_ms;
    if (event.failed()) return;
    if (const auto viseme = member_of(event, {"visemeId", "viseme_id", "VisemeId", "privVisemeId"})) {
      builder.sound(std::to_string(viseme->integer()), time, {}, viseme->pointer());
    } else if (const auto text = member_of(event, {"text", "Text", "privText"})) {  // of a word boundary
      const auto kind = member_of(event, {"boundaryType", "boundary_type", "BoundaryType", "privBoundaryType"});
      const std::string said = text->text(most_text_bytes);
      const std::string what = kind && kind->is_text() ? kind->text(most_text_bytes) : "";
      if (what.find("Sentence") != std::string::npos)
        builder.sentence(time, said, text->pointer());
      else if (what.find("Punctuation") == std::string::npos)
        builder.word(time, said, text->pointer());
    }  // bookmarks and later events
  });
}

void read_polly(std::string_view file, Builder& builder) {
  each_value(file, builder, [&](const JsonCursor& mark) {
    mark.must_be_object();
    const double time = mark.member("time").number(0.0, most_ms);
    const std::string type = mark.member("type").text(most_symbol_bytes);
    const JsonCursor value = mark.member("value");
    const std::string text = value.text(most_text_bytes);
    if (mark.failed()) return;
    if (type == "viseme")
      builder.sound(text, time, {}, value.pointer());
    else if (type == "word")
      builder.word(time, text, value.pointer());
    else if (type == "sentence")
      builder.sentence(time, text, value.pointer());
    else if (type == "ssml")
      builder.mark(time, text, value.pointer());
    else
      builder.fail(ErrorCode::out_of_range, value.pointer(), "the type must be viseme, word, sentence or ssml");
  });
}

/// Reads a document that is one object.
template <class Take>
void read_object(std::string_view file, Builder& builder, Take take) {
  const auto tree = read_json_object_tree(file, limits);
  if (!tree) return builder.fail(tree.error().code, tree.error().where, "cannot be read: " + tree.error().message);
  JsonCursor::Report report;
  take(JsonCursor(*tree, report));
  if (report) builder.fail(report->code, report->where, report->message);
}

void read_headtts(std::string_view file, Builder& builder) {
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
        const double begin = time.element(i).number(0.0, most_ms);
        take(text.element(i).text(most_text_bytes), begin, begin + duration.element(i).number(0.0, most_ms),
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
        if (!builder.failed() && end <= most_ms) builder.reach(end);
      });
  });
}

void read_rhubarb_json(std::string_view file, Builder& builder) {
  read_object(file, builder, [&](const JsonCursor& root) {
    for (const JsonCursor& cue : root.member("mouthCues").elements(1, max_timeline_events)) {
      const double begin = ms_per_s * cue.member("start").number(0.0, max_speech_seconds);
      const double end = ms_per_s * cue.member("end").number(0.0, max_speech_seconds);
      const std::string shape = cue.member("value").text(most_symbol_bytes);
      if (root.failed() || builder.failed()) return;
      builder.sound(shape, begin, end, cue.pointer());
    }
  });
}

/// The value of an attribute, `name="..."`, of the tag; empty without it.
std::string_view attribute(std::string_view tag, std::string_view name) {
  const std::string begin = " " + std::string(name) + "=\"";
  const std::size_t at = tag.find(begin);
  if (at == std::string_view::npos) return {};
  const std::string_view value = tag.substr(at + begin.size());
  return value.substr(0, value.find('"'));
}

/// The elements "mouthCue" of the document: it has no others that matter. Declarations, which could define entities,
/// are refused.
void read_rhubarb_xml(std::string_view file, Builder& builder) {
  constexpr std::string_view open = "<mouthCue ", close = "</mouthCue>";
  if (file.find("<!DOCTYPE") != std::string_view::npos)
    return builder.fail(ErrorCode::unsupported, "byte " + std::to_string(file.find("<!DOCTYPE")),
                        "the document has a declaration");
  for (std::size_t at = file.find(open); at != std::string_view::npos && !builder.failed();
       at = file.find(open, at + 1)) {
    const std::string where = "byte " + std::to_string(at);
    const std::string_view element = file.substr(at, std::min(file.find(close, at), file.size()) - at);
    const std::size_t end_of_tag = element.find('>');
    if (end_of_tag == std::string_view::npos || at + element.size() == file.size())
      return builder.fail(ErrorCode::malformed, where, "an element mouthCue has no end");
    const std::string_view tag = element.substr(0, end_of_tag);
    builder.sound(element.substr(end_of_tag + 1), seconds(attribute(tag, "start")), seconds(attribute(tag, "end")),
                  where);
  }
}

void read_rhubarb(std::string_view file, Builder& builder) {
  const std::size_t first = std::min(file.find_first_not_of(" \t\r\n"), file.size());
  if (file.substr(first).starts_with('<')) return read_rhubarb_xml(file, builder);
  if (file.substr(first).starts_with('{')) return read_rhubarb_json(file, builder);
  read_table(file, 2, builder);
}

void read_semblante(std::string_view file, Builder& builder) {
  read_object(file, builder, [&](const JsonCursor& root) {
    for (const JsonCursor& phoneme : root.member("phonemes").elements(1, max_timeline_events)) {
      const std::string stress = phoneme.text_or("stress", "none");
      const auto* const at = std::find(stress_names.begin(), stress_names.end(), stress);
      if (at == stress_names.end())
        phoneme.fail(ErrorCode::out_of_range, "the stress must be none, primary or secondary");
      SpokenPhoneme sound{phoneme.member("time").number(0.0, most_ms),
                          printable(phoneme.member("ipa").text(most_symbol_bytes)),
                          static_cast<Stress>(at - stress_names.begin())};
      const double end = phoneme.member("end").number(0.0, most_ms);
      if (root.failed() || builder.failed()) return;
      builder.stressed_sound(std::move(sound), end, phoneme.pointer());
    }
    // Places are those of the text: a file without it names its words alone.
    const auto whole = root.optional_member("text");
    if (whole) builder.whole_text(whole->text(max_utterance_text_bytes));
    if (const auto words = root.optional_member("words"))
      for (const JsonCursor& word : words->elements(0, max_timeline_events)) {
        const double time = word.member("time").number(0.0, most_ms);
        const std::string text = word.member("text").text(most_text_bytes);
        const auto first = whole ? word.member("first").integer(0, max_utterance_text_bytes) : 0;
        if (root.failed() || builder.failed()) return;
        if (whole)
          builder.placed_word(time, text, static_cast<std::size_t>(first), word.pointer());
        else
          builder.word(time, text, word.pointer());
      }
    if (const auto sentences = root.optional_member("sentences"); sentences && whole)
      for (const JsonCursor& sentence : sentences->elements(0, max_timeline_events)) {
        const double time = sentence.member("time").number(0.0, most_ms);
        const auto first = sentence.member("first").integer(0, max_utterance_text_bytes);
        if (root.failed() || builder.failed()) return;
        builder.placed_sentence(time, static_cast<std::size_t>(first), sentence.pointer());
      }
    if (const auto marks = root.optional_member("marks"))
      for (const JsonCursor& mark : marks->elements(0, max_timeline_events)) {
        const double time = mark.member("time").number(0.0, most_ms);
        const std::string name = mark.member("name").text(most_text_bytes);
        if (root.failed() || builder.failed()) return;
        builder.mark(time, name, mark.pointer());
      }
    if (const auto duration = root.optional_member("duration")) {
      const double end = duration->number(0.0, most_ms);
      if (!root.failed()) builder.reach(end);
    }
  });
}

/// The format that a file looks like, by its first signs and the members that only one has.
std::optional<TimelineFormat> looks_like(std::string_view file) {
  const std::string_view start = file.substr(std::min(file.find_first_not_of(" \t\r\n"), file.size()));
  const auto has = [&file](std::string_view name) { return file.find(name) != std::string_view::npos; };
  if (start.starts_with('{') || start.starts_with('[')) {
    if (has("\"semblante.timeline\"")) return TimelineFormat::semblante;
    if (has("\"mouthCues\"")) return TimelineFormat::rhubarb;
    if (has("\"vtimes\"")) return TimelineFormat::headtts;
    if (has("\"type\"") && has("\"value\"")) return TimelineFormat::polly;
    if (has("iseme")) return TimelineFormat::azure;
    return std::nullopt;
  }
  if (start.starts_with('<')) return TimelineFormat::rhubarb;
  const std::string_view line = start.substr(0, start.find('\n'));
  const auto columns = static_cast<std::size_t>(std::count(line.begin(), line.end(), '\t')) + 1;
  if (columns == 3) return TimelineFormat::phonemes;
  if (columns == 2) return TimelineFormat::rhubarb;
  if (has("iseme")) return TimelineFormat::azure;
  return std::nullopt;
}

/// Where `piece` is in the text, at or shortly after `from`.
std::size_t find_near(std::string_view text, std::string_view piece, std::size_t from) {
  constexpr std::size_t window = 400;
  const std::size_t at = text.substr(from, window + piece.size()).find(piece);
  return at == std::string_view::npos ? at : from + at;
}

/// Counts characters up to bytes that do not decrease.
class CharacterCount {
 public:
  explicit CharacterCount(std::string_view text) : text_(text) {}
  std::size_t at(std::size_t byte) {
    for (; byte_ < byte; ++count_) byte_ += utf8_step(text_.substr(byte_));
    return count_;
  }

 private:
  std::string_view text_;
  std::size_t byte_ = 0, count_ = 0;
};

}  // namespace

const VisemeSymbol* VisemeSymbols::find(std::string_view symbol) const {
  const auto at = std::find_if(rows.begin(), rows.end(), [&](const VisemeSymbol& row) { return row.symbol == symbol; });
  return at == rows.end() ? nullptr : &*at;
}

Result<VoiceTimeline> read_voice_timeline(std::string_view file, std::optional<TimelineFormat> format) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (file.starts_with(byte_order_mark)) file.remove_prefix(byte_order_mark.size());
  if (file.size() > max_timeline_bytes)
    return Error{ErrorCode::too_large, "", "is longer than " + std::to_string(max_timeline_bytes) + " bytes"};
  if (!format) format = looks_like(file);
  if (!format) return Error{ErrorCode::unsupported, "", "is of no format that is known here: name it"};
  const auto built = [&](const VisemeSymbols* symbols, auto read) {
    Builder builder(*format, symbols);
    read(file, builder);
    return std::move(builder).finish();
  };
  switch (*format) {
    case TimelineFormat::semblante:
      return built(nullptr, read_semblante);
    case TimelineFormat::azure:
      return built(&visemes::azure, read_azure);
    case TimelineFormat::polly:
      return built(&visemes::polly, read_polly);
    case TimelineFormat::rhubarb:
      return built(&visemes::rhubarb, read_rhubarb);
    case TimelineFormat::headtts:
      return built(&visemes::oculus, read_headtts);
    case TimelineFormat::phonemes:
      break;
  }
  return built(nullptr, [](std::string_view text, Builder& builder) { read_table(text, 3, builder); });
}

std::string text_of(const VoiceTimeline& timeline) {
  if (!timeline.text.empty()) return timeline.text;
  std::string text;
  for (const TimedText& piece : timeline.sentences.empty() ? timeline.words : timeline.sentences) {
    if (piece.text.empty()) continue;
    if (!text.empty()) text += ' ';
    text += piece.text;
  }
  return text;
}

Result<Utterance> utterance_of(const VoiceTimeline& timeline, std::string_view text, std::optional<Recording> sound,
                               std::size_t* missing) {
  Utterance said;
  said.voice = timeline_format_names[static_cast<std::size_t>(timeline.format)];
  said.duration = timeline.end;
  if (sound) {
    said.sample_rate = sound->sample_rate;
    said.samples = std::move(sound->samples);
    said.duration = 1000.0 * static_cast<double>(said.samples.size()) / said.sample_rate;
    if (timeline.end > said.duration + past_the_sound_ms)
      return Error{ErrorCode::mismatch, "", "the timeline is longer than the sound: they do not belong together"};
  }
  said.phonemes = timeline.phonemes;
  said.marks = timeline.marks;
  std::size_t lost = 0, from = 0;
  const bool own = !timeline.text.empty() && text == timeline.text;
  const Characters characters(text);
  CharacterCount words_count(text), sentences_count(text);
  for (const TimedText& word : timeline.words) {
    if (own && word.first) {
      const TextRange range{*word.first, Characters(word.text).count()};
      if (range.count > 0 && characters.of(range) == word.text)
        said.words.push_back({word.time, range});
      else
        ++lost;
      continue;
    }
    const std::size_t at = word.text.empty() ? std::string_view::npos : find_near(text, word.text, from);
    if (at == std::string_view::npos) {
      ++lost;
      continue;
    }
    from = at + word.text.size();
    const std::size_t first = words_count.at(at);
    said.words.push_back({word.time, {first, words_count.at(from) - first}});
  }
  from = 0;
  for (const TimedText& sentence : timeline.sentences) {
    if (sentence.first) {
      // In another text a sentence begins with its first word.
      const auto word = std::lower_bound(said.words.begin(), said.words.end(), sentence.time - same_time_ms,
                                         [](const SpokenWord& one, double time) { return one.time < time; });
      if (own && *sentence.first <= characters.count())
        said.sentences.push_back({sentence.time, *sentence.first});
      else if (!own && word != said.words.end())
        said.sentences.push_back({sentence.time, word->range.first});
      continue;
    }
    const std::size_t at = sentence.text.empty() ? std::string_view::npos : find_near(text, sentence.text, from);
    if (at == std::string_view::npos) continue;
    from = at + sentence.text.size();
    said.sentences.push_back({sentence.time, sentences_count.at(at)});
  }
  if (missing != nullptr) *missing = lost;
  return said;
}

}  // namespace semblante
