#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "core/tables/mpeg4.h"
#include "core/types/decimal.h"
#include "protocol/cpp/face_frame.h"
#include "protocol/cpp/messages.h"
#include "protocol/cpp/packed_codec.h"
#include "protocol/cpp/packed_state.h"
#include "protocol/cpp/range_coder.h"

namespace semblante {

/// The coder that a model is made for. Where size counts, the code of the model is there once for both directions, for
/// a branch at each bit.
#ifdef __OPTIMIZE_SIZE__
template <class Coder>
using ModelCoder = EitherCoder;
#else
template <class Coder>
using ModelCoder = Coder&;
#endif

/// The model of the packed form (SPEC.md, "Packed form"): which bits code frames and times, with which contexts. The
/// same code encodes and decodes: each function takes the value to encode (ignored by a decoding Coder) and returns the
/// encoded or decoded value. A function must not use a value before the Coder has returned it.
template <class Coder>
class PackedModel {
 public:
  PackedModel(Coder& coder, const PackedTable& table, PackedState& state)
      : coder_(coder), table_(table), state_(state) {}

  /// Codes the content of a keyframe except its sequence number and time. `source`: the state to encode.
  void history(const PackedState& source);
  /// Codes the next frame, which becomes before[0].
  void frame(FaceFrame& now);
  /// Codes the number of frames of a batch, 1 to 1024.
  std::uint64_t count(std::uint64_t value);
  /// Codes the media time of a batch, ms.
  std::uint64_t base_time(std::uint64_t value);
  /// Codes the time of the batch's first frame, ms after its media time.
  std::uint64_t offset(std::uint64_t value);
  /// Codes the time of a later frame, ms after the frame before.
  std::uint64_t step(std::uint64_t value);
  /// Codes a whole number: the length in bits of value + 1 with `most` contexts, then its bits.
  std::uint64_t number(std::size_t lengths, unsigned most, std::uint64_t value);
  bool flag(std::size_t context, bool value) { return coder_.bit(table_[context], value ? 1 : 0) != 0; }

  /// JSON pointer of the member whose decoded value is out of range; empty: none.
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  static constexpr int limit = static_cast<int>(max_level);
  static constexpr unsigned level_bits = 15;  ///< bits of a difference of levels, without its leading one
  static constexpr unsigned blend_bits = 5;
  enum Kind : std::uint8_t { line, shared, hold };
  struct Guess {
    int level;
    int cost;  ///< the error of such predictions in the previous two frames
    Kind kind;
  };

  void viseme(VisemeBlend& now);
  void share(VisemeBlend& now, bool swapped);
  void expression(ExpressionBlend& now);
  void intensity(std::uint8_t select, std::uint8_t& now);
  void group(const mpeg4::FapGroup& group, FaceFrame& now);
  int level(std::size_t fap, const FaceFrame& now, int value);
  int slow_level(std::size_t fap, std::size_t reference, int reference_step, int value);
  int residual(std::size_t differs, std::size_t sign, unsigned set, int value);
  unsigned tree(std::size_t context, unsigned bits, unsigned value);
  int signed_number(std::size_t sign, std::size_t lengths, unsigned most, int value);
  std::uint64_t timed(std::size_t first, std::uint64_t expected, std::uint64_t value, const char* where);
  [[nodiscard]] Guess guess(std::size_t fap, std::size_t reference, const FaceFrame& now) const;
  std::uint8_t bounded(int value, int most, const char* where) {
    if (value < 0 || value > most) fail(where);
    return static_cast<std::uint8_t>(std::clamp(value, 0, most));
  }
  void fail(std::string where) {
    if (fault_.empty()) fault_ = std::move(where);
  }

  static int held(int value) { return std::clamp(value, -limit, limit); }
  static int length(int value) { return static_cast<int>(std::bit_width(static_cast<unsigned>(value))); }
  static int sign_class(std::int64_t value) { return value == 0 ? 0 : value > 0 ? 1 : 2; }
  static int ratio(int reference_before, int reference_now, int before);

  Coder& coder_;
  const PackedTable& table_;
  PackedState& state_;
  std::array<int, 69> off_{};  ///< by FAP: the error of the prediction in this frame
  std::string fault_;
};

template <class Coder>
void PackedModel<Coder>::history(const PackedState& source) {
  if (!flag(packed_tables::join_differs, !source.fresh)) {
    FaceFrame now = source.before[0];
    frame(now);
    state_.before.fill(now);
    state_.viseme_class = 0;
    state_.expression_class = 0;
    return;
  }
  state_.fresh = false;
  count(source.count);
  if (step(source.step) != state_.step) fail("/step");
  state_.time_class = static_cast<std::uint8_t>(coder_.bits(2, source.time_class));
  if (state_.time_class > 2) {
    fail("/step");
    state_.time_class = 0;
  }
  for (std::size_t i = source.before.size(); i-- > 0;) {
    FaceFrame now = source.before[i];
    frame(now);
  }
}

template <class Coder>
void PackedModel<Coder>::frame(FaceFrame& now) {
  viseme(now.viseme);
  expression(now.expression);
  off_.fill(0);
  for (const auto& each : mpeg4::fap_groups) {
    if (each.number > 1) group(each, now);
  }
  for (std::size_t i = state_.before.size() - 1; i > 0; --i) state_.before[i] = state_.before[i - 1];
  state_.before[0] = now;
}

template <class Coder>
std::uint64_t PackedModel<Coder>::number(std::size_t lengths, unsigned most, std::uint64_t value) {
  const std::uint64_t more = value + 1;
  const auto wanted = static_cast<unsigned>(std::bit_width(more)) - 1U;
  assert(coder_.decodes || wanted <= most);
  unsigned bits = 0;
  while (bits < most && flag(lengths + bits, bits < wanted)) ++bits;
  if (bits == 0) return 0;
  const unsigned context = std::min(bits, 16U);
  std::uint64_t read = 2U | (flag(packed_tables::top_bit + context, (more >> (bits - 1) & 1U) != 0) ? 1U : 0U);
  if (bits > 1) {
    read = read << 1U | (flag(packed_tables::second_bit + context, (more >> (bits - 2) & 1U) != 0) ? 1U : 0U);
  }
  if (bits > 2) {
    const unsigned rest = bits - 2;
    read = read << rest | coder_.bits(rest, more & ((std::uint64_t{1} << rest) - 1));
  }
  return read - 1;
}

template <class Coder>
int PackedModel<Coder>::signed_number(std::size_t sign, std::size_t lengths, unsigned most, int value) {
  const bool negative = flag(sign, value < 0);
  const auto size = static_cast<int>(number(lengths, most, static_cast<std::uint64_t>(std::abs(value)) - 1U)) + 1;
  return negative ? -size : size;
}

template <class Coder>
unsigned PackedModel<Coder>::tree(std::size_t context, unsigned bits, unsigned value) {
  unsigned node = 1;
  for (unsigned i = bits; i-- > 0;) node = node << 1U | (flag(context + node, (value >> i & 1U) != 0) ? 1U : 0U);
  return node - (1U << bits);
}

// ---- FAPs 1 and 2

template <class Coder>
void PackedModel<Coder>::viseme(VisemeBlend& now) {
  const VisemeBlend was = state_.before[0].viseme;
  if (!flag(packed_tables::viseme_differs + state_.viseme_class, now != was)) {
    now = was;
    state_.viseme_class = 0;
    return;
  }
  // 0 same selects, 1 swapped, 2 the first stays, 3 the second becomes the first, 4 both are new
  unsigned kind = now.select1 == was.select1 && now.select2 == was.select2   ? 0U
                  : now.select1 == was.select2 && now.select2 == was.select1 ? 1U
                  : now.select1 == was.select1                               ? 2U
                  : now.select1 == was.select2                               ? 3U
                                                                             : 4U;
  const std::size_t row = was.blend != max_blend ? 2U : was.select2 == 0 ? 0U : 1U;
  const std::size_t question = packed_tables::viseme_kind + 4U * row;
  if (!flag(question, kind >= 2)) {
    kind = flag(question + 1, kind == 1) ? 1U : 0U;
  } else if (!flag(question + 2, kind > 2)) {
    kind = 2;
  } else {
    kind = flag(question + 3, kind > 3) ? 4U : 3U;
  }
  const auto select = [&](unsigned value, const char* where) {
    return bounded(static_cast<int>(tree(packed_tables::viseme_select, 4, value)), max_viseme, where);
  };
  if (kind == 4) {
    now.select1 = select(now.select1, "/viseme/select1");
  } else {
    now.select1 = kind == 1 || kind == 3 ? was.select2 : was.select1;
  }
  if (kind >= 2) {
    const bool second = flag(packed_tables::viseme_second + (kind - 2), now.select2 != 0);
    now.select2 = second ? select(now.select2, "/viseme/select2") : std::uint8_t{0};
    const std::size_t pure = second ? 0U : 1U;
    if (flag(packed_tables::blend_differs + pure, now.blend != max_blend)) {
      const auto less =
          number(packed_tables::blend_length, blend_bits, static_cast<std::uint64_t>(max_blend - now.blend) - 1U);
      now.blend = bounded(max_blend - 1 - static_cast<int>(less), max_blend, "/viseme/blend");
    } else {
      now.blend = max_blend;
    }
  } else {
    now.select2 = kind == 1 ? was.select1 : was.select2;
    share(now, kind == 1);
  }
  state_.viseme_class = static_cast<std::uint8_t>(kind + 1);
}

/// Codes the blend of an unchanged pair of visemes, predicted by continuing the share of the previous first one.
template <class Coder>
void PackedModel<Coder>::share(VisemeBlend& now, bool swapped) {
  const VisemeBlend& was = state_.before[0].viseme;
  const VisemeBlend& old = state_.before[1].viseme;
  const int from = was.blend;
  bool known = true;
  int older = from;
  if (old.select1 == was.select1 && old.select2 == was.select2) {
    older = old.blend;
  } else if (old.select1 == was.select2 && old.select2 == was.select1) {
    older = max_blend - old.blend;
  } else if (old.blend == max_blend && old.select1 == was.select1) {
    older = max_blend;
  } else if (old.blend == max_blend && old.select1 == was.select2) {
    older = 0;
  } else {
    known = false;
  }
  const int expected = std::clamp(2 * from - older, 0, static_cast<int>(max_blend));
  const std::size_t context = known ? 0U : 1U;
  int off = (swapped ? max_blend - now.blend : now.blend) - expected;
  if (flag(packed_tables::share_differs + context, off != 0)) {
    off = signed_number(packed_tables::share_sign + (from > older ? 2U : 0U) + context,
                        packed_tables::share_length + blend_bits * context, blend_bits, off);
  } else {
    off = 0;
  }
  const std::uint8_t read = bounded(expected + off, max_blend, "/viseme/blend");
  now.blend = swapped ? static_cast<std::uint8_t>(max_blend - read) : read;
}

template <class Coder>
void PackedModel<Coder>::expression(ExpressionBlend& now) {
  const ExpressionBlend was = state_.before[0].expression;
  const bool differs = flag(packed_tables::expression_differs + state_.expression_class, now != was);
  state_.expression_class = differs ? 1 : 0;
  if (!differs) {
    now = was;
    return;
  }
  const bool same = now.select1 == was.select1 && now.select2 == was.select2;
  const bool swapped = now.select1 == was.select2 && now.select2 == was.select1;
  if (!flag(packed_tables::expression_kind, !same)) {
    now.select1 = was.select1;
    now.select2 = was.select2;
  } else if (!flag(packed_tables::expression_kind + 1, !swapped)) {
    now.select1 = was.select2;
    now.select2 = was.select1;
  } else {
    const auto select = [&](std::size_t context, unsigned value, const char* where) {
      return bounded(static_cast<int>(tree(context, 3, value)), max_expression, where);
    };
    now.select1 = select(packed_tables::expression_select, now.select1, "/expression/select1");
    now.select2 = select(packed_tables::expression_select + 8, now.select2, "/expression/select2");
  }
  intensity(now.select1, now.intensity1);
  intensity(now.select2, now.intensity2);
}

/// Codes an expression's intensity, predicted by linear continuation of its earlier values in either slot.
template <class Coder>
void PackedModel<Coder>::intensity(std::uint8_t select, std::uint8_t& now) {
  const auto of = [select](const ExpressionBlend& blend, int& value) {
    if (blend.select2 == select) value = blend.intensity2;
    if (blend.select1 == select) value = blend.intensity1;
    return blend.select1 == select || blend.select2 == select;
  };
  int from = 0;
  int older = 0;
  bool known = false;
  if (select != 0) {
    known = of(state_.before[0].expression, from);
    of(state_.before[1].expression, older);
  }
  const int expected = std::clamp(2 * from - older, 0, static_cast<int>(max_blend));
  const std::size_t row = select == 0 ? 2U : known ? 0U : 1U;
  const std::size_t context = 3U * row + (!known || from == older ? 0U : from < older ? 1U : 2U);
  int off = now - expected;
  if (flag(packed_tables::intensity_differs + context, off != 0)) {
    off = signed_number(packed_tables::intensity_sign + context,
                        packed_tables::intensity_length + (known ? 0U : blend_bits), blend_bits, off);
  } else {
    off = 0;
  }
  now = bounded(expected + off, max_blend, "/expression");
}

// ---- FAPs 3 to 68

template <class Coder>
void PackedModel<Coder>::group(const mpeg4::FapGroup& group, FaceFrame& now) {
  const auto& before = state_.before;
  std::uint32_t still = 0;
  bool moves = false;
  for (std::size_t fap = group.first_fap; fap <= group.last_fap; ++fap) {
    const std::size_t reference = packed_tables::references[fap];
    const int a = before[0].level[fap];
    if (before[1].level[fap] != a || before[2].level[fap] != a || before[3].level[fap] != a) continue;
    // A reference in another group was coded earlier.
    if (reference != 0 && reference < group.first_fap && now.level[reference] != before[0].level[reference]) continue;
    still |= 1U << (fap - group.first_fap);
    moves |= now.level[fap] != a;
  }
  if (still != 0) {
    const bool all = still == (1U << (group.last_fap - group.first_fap + 1U)) - 1U;
    moves = flag(packed_tables::group_moves + std::size_t{2} * (group.number - 2U) + (all ? 1U : 0U), moves);
  }
  for (std::size_t fap = group.first_fap; fap <= group.last_fap; ++fap) {
    if (!moves && (still >> (fap - group.first_fap) & 1U) != 0) {
      now.level[fap] = before[0].level[fap];
      continue;
    }
    const int value = level(fap, now, now.level[fap]);
    if (value < -limit || value > limit) fail("/faps/" + natural_text(fap));
    now.level[fap] = static_cast<std::int16_t>(held(value));
  }
}

template <class Coder>
int PackedModel<Coder>::level(std::size_t fap, const FaceFrame& now, int value) {
  const auto& before = state_.before;
  const std::size_t reference = packed_tables::references[fap];
  const Guess best = guess(fap, reference, now);
  const int reference_step = reference == 0 ? 0 : now.level[reference] - before[0].level[reference];
  const auto reference_off = static_cast<std::size_t>(reference == 0 ? 0 : sign_class(off_[reference]));
  const std::size_t off_flag = reference_off != 0 ? 1U : 0U;
  const auto slow = [&](std::size_t i) { return std::abs(before[i].level[fap] - before[i + 1].level[fap]) <= 1; };

  if (best.kind == shared && best.cost == 0) {  // the FAP has followed its reference exactly
    const auto reach = static_cast<unsigned>(std::min(length(std::abs(reference_step)), 7));
    value = best.level + residual(packed_tables::follower_differs + std::size_t{2} * reach + off_flag,
                                  packed_tables::follower_sign + reference_off, 10U + std::min(reach, 4U),
                                  value - best.level);
  } else if (slow(0) && slow(1) && slow(2) && (best.kind != shared || reference_step == 0)) {
    value = slow_level(fap, reference, reference_step, value);
  } else {
    const auto reach = static_cast<unsigned>(std::min(length(best.cost), 9));
    const std::size_t row = reference == 0 ? 0U : (best.kind == shared ? 1U : 3U) + off_flag;
    value =
        best.level + residual(packed_tables::level_differs + 10U * row + reach,
                              packed_tables::level_sign + 3U * best.kind + reference_off, reach, value - best.level);
  }
  off_[fap] = value - best.level;
  return value;
}

/// Codes a FAP that moves by less than a level per frame: the pattern of its steps predicts better than a line.
template <class Coder>
int PackedModel<Coder>::slow_level(std::size_t fap, std::size_t reference, int reference_step, int value) {
  const auto& before = state_.before;
  const int a = before[0].level[fap];
  const int b = before[1].level[fap];
  const int c = before[2].level[fap];
  int pattern = 9 * (a - b) + 3 * (b - c) + (c - before[3].level[fap]);
  const int direction = pattern < 0 ? -1 : 1;
  pattern *= direction;
  const std::size_t moves =
      reference == 0 ? 0U : std::min<std::size_t>(static_cast<std::size_t>(std::abs(reference_step)), 2U);
  const std::size_t context = 2U * static_cast<std::size_t>(pattern) + (moves != 0 ? 1U : 0U);
  int step = (value - a) * direction;
  if (!flag(packed_tables::slow_differs + context, step != 0)) return a;
  const bool back = flag(packed_tables::slow_sign + context, step < 0);
  int size = std::abs(step);
  if (flag(packed_tables::slow_more + 2U * moves + (pattern != 0 ? 1U : 0U), size > 1)) {
    const std::size_t set = moves == 2 ? 16U : 15U;
    size = static_cast<int>(number(packed_tables::level_length + std::size_t{level_bits} * set, level_bits,
                                   static_cast<std::uint64_t>(size) - 2U)) +
           2;
  } else {
    size = 1;
  }
  return a + direction * (back ? -size : size);
}

template <class Coder>
int PackedModel<Coder>::residual(std::size_t differs, std::size_t sign, unsigned set, int value) {
  if (!flag(differs, value != 0)) return 0;
  return signed_number(sign, packed_tables::level_length + std::size_t{level_bits} * set, level_bits, value);
}

/// Predicts `now` as before * reference_now / reference_before, rounded to the nearest, halves away from zero; if that
/// is more than twice the reference's step away from `before`, as before + the reference's step.
template <class Coder>
int PackedModel<Coder>::ratio(int reference_before, int reference_now, int before) {
  if (reference_before == 0) return before;
  const int product = reference_now * before;  // both below 2^15
  const int size = std::abs(reference_before);
  const int quotient = (std::abs(product) + size / 2) / size;
  const int level = (product < 0) == (reference_before < 0) ? quotient : -quotient;
  const int step = reference_now - reference_before;
  return held(std::abs(level - before) > 2 * std::abs(step) ? before + step : level);
}

template <class Coder>
typename PackedModel<Coder>::Guess PackedModel<Coder>::guess(std::size_t fap, std::size_t reference,
                                                             const FaceFrame& now) const {
  const auto& before = state_.before;
  const int a = before[0].level[fap];
  const int b = before[1].level[fap];
  const int c = before[2].level[fap];
  const int d = before[3].level[fap];
  const Guess line_guess{held(2 * a - b), 2 * std::abs(a - held(2 * b - c)) + std::abs(b - held(2 * c - d)), line};
  const Guess hold_guess{a, 2 * std::abs(a - b) + std::abs(b - c), hold};
  if (reference == 0) return line_guess.cost <= hold_guess.cost ? line_guess : hold_guess;

  const int r = now.level[reference];
  const int ra = before[0].level[reference];
  const int rb = before[1].level[reference];
  const int rc = before[2].level[reference];
  Guess best{held(a + r - ra), 2 * std::abs(a - held(b + ra - rb)) + std::abs(b - held(c + rb - rc)), shared};
  if (best.cost == 0) return best;  // most FAPs follow exactly, and ratios need divisions
  const int ratio_cost = 2 * std::abs(a - ratio(rb, ra, b)) + std::abs(b - ratio(rc, rb, c));
  if (ratio_cost < best.cost) best = {ratio(ra, r, a), ratio_cost, shared};
  if (line_guess.cost < best.cost) best = line_guess;
  if (hold_guess.cost < best.cost) best = hold_guess;
  return best;
}

// ---- numbers and times

template <class Coder>
std::uint64_t PackedModel<Coder>::count(std::uint64_t value) {
  if (flag(packed_tables::count_differs, value != state_.count)) {
    value = number(packed_tables::count_length, 10, value - 1) + 1;
    if (value > max_frames_per_message) fail("/frames");
  } else {
    value = state_.count;
  }
  state_.count = static_cast<std::uint16_t>(std::min<std::uint64_t>(value, max_frames_per_message));
  return value;
}

/// `first`: 0 for the first frame of a batch, 1 for later ones.
template <class Coder>
std::uint64_t PackedModel<Coder>::timed(std::size_t first, std::uint64_t expected, std::uint64_t value,
                                        const char* where) {
  const auto late = static_cast<std::int64_t>(value - expected);
  if (!flag(packed_tables::time_differs + 3U * first + state_.time_class, late != 0)) {
    state_.time_class = 0;
    return expected;
  }
  const bool early = flag(packed_tables::time_sign + first, late < 0);
  const std::uint64_t size =
      number(packed_tables::time_length, 53, static_cast<std::uint64_t>(std::abs(late)) - 1U) + 1;
  state_.time_class = early ? 2 : 1;
  if (early ? size > expected : size > max_media_time - expected) {
    fail(where);
    return expected;
  }
  return early ? expected - size : expected + size;
}

template <class Coder>
std::uint64_t PackedModel<Coder>::base_time(std::uint64_t value) {
  const std::uint64_t expected = std::min(state_.media_time + state_.step, max_media_time);
  value = timed(0, expected, value, "/media_time");
  if (value > state_.media_time && value - state_.media_time <= max_frame_time) {
    state_.step = static_cast<std::uint32_t>(value - state_.media_time);
  }
  state_.media_time = value;
  return value;
}

template <class Coder>
std::uint64_t PackedModel<Coder>::offset(std::uint64_t value) {
  if (!flag(packed_tables::offset_differs, value != 0)) return 0;
  value = number(packed_tables::time_length, 53, value - 1) + 1;
  state_.media_time = std::min(state_.media_time + value, max_media_time);
  return value;
}

template <class Coder>
std::uint64_t PackedModel<Coder>::step(std::uint64_t value) {
  value = timed(1, state_.step, value, "/time");
  if (value > 0 && value <= max_frame_time) state_.step = static_cast<std::uint32_t>(value);
  state_.media_time = std::min(state_.media_time + value, max_media_time);
  return value;
}

}  // namespace semblante
