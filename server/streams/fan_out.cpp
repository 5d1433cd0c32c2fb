#include "server/streams/fan_out.h"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "server/streams/stream_peer.h"

namespace semblante::streams {
namespace {

using Clock = FanOut::Clock;

/// Subscribers per slice, after which another stream has its turn.
constexpr std::size_t slice_size = 256;
/// The clock is read once per this number of messages.
constexpr std::size_t messages_per_look = 64;

}  // namespace

void Slice::send(http::GroupSender& sender, metrics::LatenessHistogram& lateness) {
  metrics::LatenessPart part(metrics::lateness_bounds);
  for (std::size_t begin = 0; begin < deliveries_.size(); begin += messages_per_look) {
    const auto group = std::span(deliveries_).subspan(begin, std::min(messages_per_look, deliveries_.size() - begin));
    sender.send(group);
    std::uint64_t handed = 0;
    for (const auto& delivery : group) {
      if (delivery.sent == http::Sent::handed) ++handed;
      if (delivery.sent == http::Sent::refused && content_ != Content::sound)
        replaced_ += delivery.sink->drop_state() + 1;
    }
    if (content_ == Content::batch) part.observe(std::chrono::duration<double>(Clock::now() - due_).count(), handed);
  }
  lateness.add(part);
}

std::array<std::size_t, coding_count> FanOut::by_coding() const {
  std::array<std::size_t, coding_count> counts{};
  for (const auto& subscriber : subscribers_.all()) ++counts[static_cast<std::size_t>(subscriber.coding)];
  return counts;
}

void FanOut::count_sent(const http::WireMessage& message) {
  ++counts_.messages_sent;
  counts_.bytes_sent += message.bytes.size();
}

void FanOut::add(StreamPeer& client, http::WebSocketSink& sink, Coding coding, Wishes wishes,
                 const http::WireMessage& begin, bool waits, const BatchLog& log) {
  Subscriber subscriber;
  subscriber.client = &client;
  subscriber.sink = &sink;
  subscriber.slot = &client.notes().subscriber;
  subscriber.next_batch = log.batches() + 1;
  subscriber.coding = coding;
  subscriber.listens = wishes.sound;
  subscriber.reads = wishes.text;
  subscriber.captions = wishes.captions;
  subscriber.away = wishes.text && is_text_;
  subscriber.told = hush_ ? hush_->text.speech : 0;
  subscriber.waits = waits;
  if (wishes.sound) ++listeners_;
  if (wishes.text) ++readers_;
  if (wishes.captions) ++captioned_;
  count_sent(begin);
  send_texts(subscriber, Clock::now());
  subscribers_.add(subscriber);
}

void FanOut::remove(StreamPeer& client) {
  if (client.notes().subscriber != Subscriber::nowhere) drop(client.notes().subscriber);
}

void FanOut::remove_all() {
  while (subscribers_.size() > 0) drop(subscribers_.size() - 1);
}

void FanOut::drop(std::size_t slot) {
  if (subscribers_[slot].listens) --listeners_;
  if (subscribers_[slot].reads) --readers_;
  if (subscribers_[slot].captions) --captioned_;
  subscribers_.remove(slot);
}

void FanOut::push(std::shared_ptr<Batch> batch) {
  if (subscribers_.size() == 0) return;
  const auto due = batch->due;
  passes_.push_back({Kind::batch, std::move(batch), {}, {}, due, is_text_});
}

void FanOut::push_sound(SoundPacket sound, Clock::time_point due) {
  if (listeners_ == 0) return;
  if (sounds_ >= most_sounds) {
    counts_.sound_dropped += listeners_;
    return;
  }
  passes_.push_back({Kind::sound, nullptr, std::move(sound), {}, due, is_text_});
  ++sounds_;
}

void FanOut::push_text(SpeechText text, Clock::time_point due, Clock::time_point until, bool replaces) {
  if (replaces) is_text_ = true;
  std::erase_if(said_, [now = Clock::now()](const Said& one) { return one.until < now; });
  said_.push_back({text, until, replaces, {}});
  if (captioned_ + (replaces ? readers_ : 0) > 0)
    passes_.push_back({Kind::text, nullptr, std::move(text), {}, due, replaces});
}

void FanOut::hush(SpeechText hush, Clock::time_point now) {
  said_.clear();
  hush_ = Said{hush, now, is_text_, {}};
  if (readers_ + captioned_ > 0) passes_.push_back({Kind::text, nullptr, std::move(hush), {}, now, is_text_});
}

void FanOut::end_text(Clock::time_point now) {
  is_text_ = false;
  said_.clear();
  if (readers_ > 0) passes_.push_back({Kind::newest, nullptr, {}, {}, now, false});
}

bool FanOut::says(Clock::time_point now) const {
  return std::any_of(said_.begin(), said_.end(), [now](const Said& one) { return one.until > now; });
}

bool FanOut::reads(StreamPeer& client) const {
  const auto slot = client.notes().subscriber;
  return slot != Subscriber::nowhere && subscribers_.all()[slot].reads;
}

void FanOut::set_reads(StreamPeer& client, bool reads, BatchLog& log) {
  const auto slot = client.notes().subscriber;
  if (slot == Subscriber::nowhere || subscribers_[slot].reads == reads) return;
  auto& subscriber = subscribers_[slot];
  subscriber.reads = reads;
  readers_ = reads ? readers_ + 1 : readers_ - 1;
  if (reads) {
    subscriber.away = is_text_;
    subscriber.told = hush_ ? hush_->text.speech : 0;
    send_texts(subscriber, Clock::now());
  } else if (subscriber.away) {
    subscriber.away = false;
    subscriber.behind = true;
    send_newest(subscriber, log);
  }
}

void FanOut::set_captions(StreamPeer& client, bool captions) {
  const auto slot = client.notes().subscriber;
  if (slot == Subscriber::nowhere || subscribers_[slot].captions == captions) return;
  auto& subscriber = subscribers_[slot];
  const bool had_text = subscriber.reads && is_text_;
  subscriber.captions = captions;
  captioned_ = captions ? captioned_ + 1 : captioned_ - 1;
  if (!captions || had_text) return;
  subscriber.told = hush_ ? hush_->text.speech : 0;
  send_texts(subscriber, Clock::now());
}

bool FanOut::send_text(Subscriber& subscriber, Said& said) {
  auto& wire = said.wires[static_cast<std::size_t>(subscriber.coding)];
  if (!wire) {
    http::WireMessage message;
    append_encoded(message.bytes, said.text, subscriber.coding == Coding::packed, standard_quantizers());
    wire = std::make_shared<const http::WireMessage>(std::move(message));
  }
  const auto sent = subscriber.sink->send(wire, http::Purpose::state);
  if (sent != http::Sent::handed) subscriber.waits = true;
  if (sent != http::Sent::handed && sent != http::Sent::waits) return false;
  subscriber.told = said.text.speech;
  ++counts_.texts_sent;
  counts_.text_bytes_sent += wire->bytes.size();
  return true;
}

void FanOut::send_texts(Subscriber& subscriber, Clock::time_point now) {
  for (auto& said : said_)
    if (said.until >= now && said.is_for(subscriber) && !send_text(subscriber, said)) return;
}

const http::SharedWire& FanOut::message_wire(Pass& pass, Coding coding) {
  auto& wire = pass.wires[static_cast<std::size_t>(coding)];
  if (wire) return wire;
  http::WireMessage message;
  append_encoded(message.bytes, pass.message, coding == Coding::packed, standard_quantizers());
  return wire = std::make_shared<const http::WireMessage>(std::move(message));
}

const http::SharedWire* FanOut::next_wire(Slice& slice, Subscriber& subscriber, BatchLog& log) {
  auto& pass = passes_.front();
  auto& wire = slice.wires_[static_cast<std::size_t>(subscriber.coding)];
  if (pass.kind == Kind::newest) {
    if (!subscriber.away) return nullptr;
    subscriber.away = false;
    subscriber.behind = true;
    send_newest(subscriber, log);
    return nullptr;
  }
  if (pass.kind == Kind::text) {
    const bool is_for = subscriber.captions || (pass.of_text && subscriber.reads);
    if (!is_for || subscriber.behind) return nullptr;  // with the newest state come the texts
    subscriber.told = std::get<SpeechText>(pass.message).speech;
    if (!wire) wire = message_wire(pass, subscriber.coding);
    return &wire;
  }
  const bool reads = subscriber.reads && pass.of_text;
  if (pass.kind == Kind::sound) {
    if (!subscriber.listens || reads) return nullptr;
    if (subscriber.behind || subscriber.waits) {
      ++counts_.sound_dropped;
      return nullptr;
    }
    if (!wire) wire = message_wire(pass, subscriber.coding);
    return &wire;
  }
  if (subscriber.next_batch > pass.batch->number) return nullptr;
  subscriber.next_batch = pass.batch->number + 1;
  if (reads) {
    subscriber.away = true;
    return nullptr;
  }
  if (subscriber.behind) {
    ++counts_.messages_replaced;
    return nullptr;
  }
  if (!wire) wire = log.wire(*pass.batch, subscriber.coding);
  return &wire;
}

bool FanOut::next_slice(Slice& slice, BatchLog& log) {
  if (passes_.empty()) return false;
  slice.targets_.clear();
  slice.deliveries_.clear();
  slice.wires_ = {};
  slice.due_ = passes_.front().due;
  const auto kind = passes_.front().kind;
  slice.content_ = kind == Kind::sound  ? Slice::Content::sound
                   : kind == Kind::text ? Slice::Content::text
                                        : Slice::Content::batch;
  slice.replaced_ = 0;
  for (auto& subscriber : subscribers_.next(slice_size)) {
    const auto* wire = next_wire(slice, subscriber, log);
    if (wire == nullptr) continue;
    slice.targets_.push_back({subscriber.client, subscriber.coding});
    slice.deliveries_.push_back({subscriber.sink, wire, http::Sent::refused});
  }
  return true;
}

void FanOut::finish_slice(Slice& slice, BatchLog& log) {
  counts_.messages_replaced += slice.replaced_;
  for (std::size_t i = 0; i < slice.targets_.size(); ++i) {
    const auto& target = slice.targets_[i];
    const auto sent = slice.deliveries_[i].sent;
    if (sent == http::Sent::closed) continue;
    if (sent != http::Sent::refused) {
      const auto& wire = *slice.wires_[static_cast<std::size_t>(target.coding)];
      if (slice.content_ == Slice::Content::sound) {
        ++counts_.sound_sent;
        counts_.sound_bytes_sent += wire.bytes.size();
      } else if (slice.content_ == Slice::Content::text) {
        ++counts_.texts_sent;
        counts_.text_bytes_sent += wire.bytes.size();
      } else {
        count_sent(wire);
      }
      if (sent == http::Sent::handed) continue;
    }
    const auto slot = target.client->notes().subscriber;
    if (slot == Subscriber::nowhere) continue;  // removed meanwhile
    auto& subscriber = subscribers_[slot];
    subscriber.waits = true;
    if (sent != http::Sent::refused) continue;
    if (slice.content_ == Slice::Content::sound) {
      ++counts_.sound_dropped;
      continue;
    }
    subscriber.behind = true;
    subscriber.told = 0;  // what waited has been dropped
    // The socket may have become writable meanwhile; no other event would report that.
    if (subscriber.sink->idle()) send_newest(subscriber, log);
  }
  slice.wires_ = {};
  if (!subscribers_.pass_done()) return;
  if (!passes_.empty()) {
    if (passes_.front().kind == Kind::sound) --sounds_;
    passes_.pop_front();
  }
  subscribers_.begin_pass();
}

void FanOut::send_rest(BatchLog& log) {
  for (auto& subscriber : subscribers_.all()) {
    for (const auto& pass : passes_) {
      const auto& batch = pass.batch;
      if (!batch || (subscriber.reads && pass.of_text)) continue;
      if (subscriber.behind) break;
      if (subscriber.next_batch > batch->number) continue;
      const auto& wire = log.wire(*batch, subscriber.coding);
      const auto sent = subscriber.sink->send(wire, http::Purpose::state);
      subscriber.behind = sent == http::Sent::refused;
      if (subscriber.behind) counts_.messages_replaced += subscriber.sink->drop_state() + 1;
      if (sent == http::Sent::handed || sent == http::Sent::waits) count_sent(*wire);
    }
    if (subscriber.behind) send_newest(subscriber, log);
  }
  passes_.clear();
  sounds_ = 0;
}

void FanOut::writable(StreamPeer& client, BatchLog& log) {
  const auto slot = client.notes().subscriber;
  if (slot == Subscriber::nowhere) return;
  auto& subscriber = subscribers_[slot];
  subscriber.waits = false;
  if (subscriber.behind) send_newest(subscriber, log);
}

void FanOut::send_newest(Subscriber& subscriber, BatchLog& log) {
  if (hush_ && hush_->is_for(subscriber) && subscriber.told < hush_->text.speech && !send_text(subscriber, *hush_))
    return;
  const auto& newest = log.join_point(subscriber.coding);
  const auto sent = subscriber.sink->send(newest, http::Purpose::state);
  if (sent == http::Sent::waits || sent == http::Sent::refused) subscriber.waits = true;
  if (sent == http::Sent::refused) return;  // the subscriber stays behind until its socket is writable
  subscriber.behind = false;
  subscriber.next_batch = log.batches() + 1;
  count_sent(*newest);
  send_texts(subscriber, Clock::now());
}

std::vector<StreamPeer*> FanOut::remove_stalled(std::chrono::milliseconds patience, Clock::time_point now) {
  std::vector<StreamPeer*> stalled;
  for (auto& subscriber : subscribers_.all()) {
    if (!subscriber.waits) continue;
    const auto since = subscriber.sink->stalled_since();
    if (!since)
      subscriber.waits = subscriber.behind;
    else if (now - *since > patience)
      stalled.push_back(subscriber.client);
  }
  for (auto* client : stalled) {
    counts_.messages_dropped += subscribers_[client->notes().subscriber].sink->drop_state();
    drop(client->notes().subscriber);
  }
  return stalled;
}

}  // namespace semblante::streams
