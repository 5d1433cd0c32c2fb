#include "server/api/live_speech.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <system_error>
#include <utility>

#include "server/log/guard.h"
#include "server/log/log.h"

namespace semblante::api {
namespace {

/// Of sound that is coded at once: 9 ms of work.
constexpr double piece_ms = 1000.0;

}  // namespace

Status LiveSpeech::add_sound(streams::GrowingSource& source, voice::SoundCoder& coder) {
  auto coded = coder.code(piece_ms);
  if (!coded) return coded.error();
  std::vector<SoundPacket> packets;
  for (auto& one : *coded) packets.push_back({one.time, std::move(one.packet)});
  return source.add_sound(std::move(packets));
}

Status LiveSpeech::add_part(streams::GrowingSource& source, voice::SoundCoder& coder, voice::SpeechPart part) {
  const double end = coder.end();
  if (const auto added = coder.add(part.sound.samples, part.sound.sample_rate); !added) return added.error();
  const auto begin = source.add_part(part.face, part.lead, coder.end() - end);
  if (!begin) return begin.error();
  coder.pause(*begin - end);
  for (auto& text : part.texts)
    text.media_time = static_cast<std::uint64_t>(
        std::max(0.0, std::round(static_cast<double>(text.media_time) + *begin - part.lead)));
  return source.add_texts(std::move(part.texts));
}

Result<LiveSpeech> LiveSpeech::of_text(voice::SpeechParts parts, const QuantizerSteps& steps) {
  auto coder = voice::SoundCoder::make();
  if (!coder) return coder.error();
  LiveSpeech speech(steps, *std::move(coder));
  auto first = parts.next();
  if (!first) return first.error();
  if (const auto added = add_part(*speech.source_, speech.coder_, *std::move(first)); !added) return added.error();
  if (const auto added = add_sound(*speech.source_, speech.coder_); !added) return added.error();
  if (!parts.done()) speech.parts_ = std::move(parts);
  if (speech.done()) speech.source_->finish();
  return speech;
}

Result<LiveSpeech> LiveSpeech::of_speech(const PerformanceScript& face, const Recording& sound,
                                         std::vector<SpeechText> texts, const QuantizerSteps& steps) {
  auto coder = voice::SoundCoder::make();
  if (!coder) return coder.error();
  LiveSpeech speech(steps, *std::move(coder));
  const auto compiled = Performance::compile(face);
  if (!compiled) return compiled.error();
  if (const auto added = speech.source_->add_part(face, 0.0, compiled->duration()); !added) return added.error();
  if (const auto added = speech.source_->add_texts(std::move(texts)); !added) return added.error();
  if (!sound.samples.empty()) {
    if (const auto added = speech.coder_.add(sound.samples, sound.sample_rate); !added) return added.error();
    if (const auto added = add_sound(*speech.source_, speech.coder_); !added) return added.error();
  }
  if (speech.done()) speech.source_->finish();
  return speech;
}

void LiveSpeech::make_rest(LiveSpeech speech, Speakers& speakers, std::shared_ptr<void> place) {
  if (speech.done()) return;
  const std::weak_ptr<streams::GrowingSource> played = std::exchange(speech.source_, nullptr);
  const auto fail = [played](const std::string& why) {
    log::warning("the rest of a speech: " + why);
    if (const auto source = played.lock()) source->fail(why);
  };
  const auto rest = std::make_shared<LiveSpeech>(std::move(speech));
  try {
    speakers.start(std::move(place), [played, rest, fail, &speakers] {
      Status made = Unit{};
      if (!log::guarded("making the rest of a speech", [&] { made = rest->make_all(played, speakers); }))
        fail("the server has failed");
      else if (!made)
        fail(made.error().message);
    });
  } catch (const std::system_error& fault) {
    fail(fault.what());
  }
}

Status LiveSpeech::make_all(const std::weak_ptr<streams::GrowingSource>& played, Speakers& speakers) {
  const std::function<bool()> wanted = [&] { return !played.expired() && !speakers.stopping(); };
  Status made = Unit{};
  // The source is held only for an instant: when its player lets go of it, nothing more is wanted.
  const auto code = [&] {
    while (made && wanted() && !coder_.done())
      if (const auto source = played.lock()) made = add_sound(*source, coder_);
  };
  code();
  while (made && wanted() && parts_) {
    Result<voice::SpeechPart> part = Error{ErrorCode::cancelled, "", ""};
    speakers.take_turn(wanted, [&] { part = parts_->next(wanted); });
    if (!wanted()) break;
    if (!part) return Error{part.error().code, "", "the voice: " + part.error().message};
    if (parts_->done()) parts_.reset();
    if (const auto source = played.lock()) made = add_part(*source, coder_, *std::move(part));
    code();
  }
  if (const auto source = played.lock(); made && source) source->finish();
  return made;
}

}  // namespace semblante::api
