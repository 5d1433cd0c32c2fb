#include "server/voice/pocketsphinx/recognizer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <pocketsphinx.h>
#include <sstream>
#include <string_view>
#include <unistd.h>
#include <utility>

#include <sphinxbase/err.h>
#include <sphinxbase/fsg_model.h>
#include <sys/mman.h>

namespace semblante::voice {
namespace {

constexpr const char* model_folder = "/usr/share/pocketsphinx/model/en-us";
constexpr double ms_per_frame = 10.0;

/// The phones of the CMU dictionary (R. Weide, The Carnegie Mellon Pronouncing Dictionary, 1998) in IPA.
constexpr std::array<std::pair<const char*, const char*>, 39> phones_of_cmu = {
    {{"AA", "ɑ"},  {"AE", "æ"},  {"AH", "ʌ"},  {"AO", "ɔ"}, {"AW", "aʊ"}, {"AY", "aɪ"}, {"B", "b"}, {"CH", "tʃ"},
     {"D", "d"},   {"DH", "ð"},  {"EH", "ɛ"},  {"ER", "ɝ"}, {"EY", "eɪ"}, {"F", "f"},   {"G", "ɡ"}, {"HH", "h"},
     {"IH", "ɪ"},  {"IY", "i"},  {"JH", "dʒ"}, {"K", "k"},  {"L", "l"},   {"M", "m"},   {"N", "n"}, {"NG", "ŋ"},
     {"OW", "oʊ"}, {"OY", "ɔɪ"}, {"P", "p"},   {"R", "ɹ"},  {"S", "s"},   {"SH", "ʃ"},  {"T", "t"}, {"TH", "θ"},
     {"UH", "ʊ"},  {"UW", "u"},  {"V", "v"},   {"W", "w"},  {"Y", "j"},   {"Z", "z"},   {"ZH", "ʒ"}}};

/// A file in memory that the library can open by its path.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view content) : file_(::memfd_create("dictionary", 0)) {
    written_ = file_ >= 0 && ::write(file_, content.data(), content.size()) == static_cast<ssize_t>(content.size());
  }
  ~MemoryFile() {
    if (file_ >= 0) ::close(file_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  [[nodiscard]] bool is_written() const { return written_; }
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
  int file_;
  bool written_ = false;
};

/// A dictionary whose words are the phones.
std::string dictionary_of_phones() {
  std::string lines;
  for (const auto& [name, ipa] : phones_of_cmu) lines += std::string(name) + " " + name + "\n";
  return lines;
}

ps_decoder_t* decoder_with(const std::vector<std::string>& options) {
  std::vector<char*> arguments;
  std::string program = "recognizer";
  std::vector<std::string> own = options;
  arguments.push_back(program.data());
  for (std::string& option : own) arguments.push_back(option.data());
  cmd_ln_t* const config =
      cmd_ln_parse_r(nullptr, ps_args(), static_cast<int>(arguments.size()), arguments.data(), TRUE);
  if (config == nullptr) return nullptr;
  ps_decoder_t* const decoder = ps_init(config);
  cmd_ln_free_r(config);  // the decoder holds its own reference
  return decoder;
}

/// Decodes the sound as one utterance; the means of its spectrum are those of the whole.
bool decode(ps_decoder_t* decoder, std::span<const std::int16_t> samples) {
  return ps_start_utt(decoder) == 0 && ps_process_raw(decoder, samples.data(), samples.size(), FALSE, TRUE) >= 0 &&
         ps_end_utt(decoder) == 0;
}

/// Calls `take` with each segment of what was found and its word.
template <class Take>
void each_segment(ps_decoder_t* decoder, Take take) {
  for (ps_seg_t* segment = ps_seg_iter(decoder); segment != nullptr; segment = ps_seg_next(segment)) {
    const char* const word = ps_seg_word(segment);
    if (word != nullptr) take(segment, std::string(word));
  }
}

/// Silence and noises are "<sil>", "[NOISE]" and the like; the ends of sentences "<s>" and "</s>".
bool is_word(std::string_view word) {
  return !word.empty() && (std::isalpha(static_cast<unsigned char>(word[0])) != 0 || word[0] == '\'');
}

/// "and(2)", the second pronunciation of the word: "and".
std::string spelled(const std::string& word) {
  std::string text = word.substr(0, word.find('('));
  if (text == "i" || text.starts_with("i'")) text[0] = 'I';
  return text;
}

const char* ipa_of(const std::string& phone) {
  const auto* const known =
      std::find_if(phones_of_cmu.begin(), phones_of_cmu.end(), [&](const auto& row) { return row.first == phone; });
  return known == phones_of_cmu.end() ? "" : known->second;
}

/// The phones of each word at equal distances within it, for a sound that the grammar did not reach the end of.
std::vector<RecognizedPhone> spread(const std::vector<RecognizedWord>& words, const std::vector<std::string>& phones,
                                    const std::vector<std::size_t>& counts) {
  std::vector<RecognizedPhone> found;
  std::size_t at = 0;
  for (std::size_t w = 0; w < words.size(); ++w) {
    const auto& [begin, end, text, confidence] = words[w];
    if (w == 0 || words[w - 1].end < begin) found.push_back({w == 0 ? 0.0 : words[w - 1].end, ""});
    for (std::size_t i = 0; i < counts[w]; ++i, ++at)
      found.push_back(
          {begin + (end - begin) * static_cast<double>(i) / static_cast<double>(counts[w]), ipa_of(phones[at])});
  }
  found.push_back({words.back().end, ""});
  return found;
}

}  // namespace

void Recognizer::Free::operator()(ps_decoder_s* decoder) const { ps_free(decoder); }

Result<Recognizer> Recognizer::load() {
  err_set_logfp(nullptr);
  const std::string folder = model_folder;
  const auto missing = [](const std::string& what) {
    return Error{ErrorCode::missing, "", "pocketsphinx cannot read " + what + ": is pocketsphinx-en-us installed?"};
  };
  if (!std::filesystem::exists(folder + "/en-us.lm.bin")) return missing(folder);
  // Pauses stay in: times are those of the whole sound.
  const std::vector<std::string> common = {"-hmm", folder + "/en-us", "-remove_silence", "no"};
  auto options = common;
  for (const std::string& option :
       {std::string("-lm"), folder + "/en-us.lm.bin", std::string("-dict"), folder + "/cmudict-en-us.dict"})
    options.push_back(option);
  Decoder words(decoder_with(options));
  if (!words) return missing(folder);
  const MemoryFile dictionary(dictionary_of_phones());
  if (!dictionary.is_written()) return Error{ErrorCode::io, "", "there is no memory for a dictionary"};
  options = common;
  // Wide beams: the grammar has one path, which must not be lost.
  for (const std::string& option :
       {std::string("-dict"), dictionary.path(), std::string("-beam"), std::string("1e-120"), std::string("-wbeam"),
        std::string("1e-120"), std::string("-pbeam"), std::string("1e-120")})
    options.push_back(option);
  Decoder phones(decoder_with(options));
  if (!phones) return missing(folder);
  return Recognizer(std::move(words), std::move(phones));
}

RecognizedPiece Recognizer::hear(std::span<const std::int16_t> samples) {
  RecognizedPiece piece;
  if (!decode(words_.get(), samples)) return piece;
  std::vector<std::string> phones;
  std::vector<std::size_t> counts;  // of phones, by word
  each_segment(words_.get(), [&](ps_seg_t* segment, const std::string& word) {
    if (!is_word(word)) return;
    char* const said = ps_lookup_word(words_.get(), word.c_str());
    if (said == nullptr) return;
    std::istringstream names(said);
    ckd_free(said);
    const std::size_t before = phones.size();
    for (std::string name; names >> name;) phones.push_back(name);
    if (phones.size() == before) return;
    int first = 0, last = 0;
    ps_seg_frames(segment, &first, &last);
    const double probability =
        logmath_exp(ps_get_logmath(words_.get()), ps_seg_prob(segment, nullptr, nullptr, nullptr));
    piece.words.push_back({ms_per_frame * first, ms_per_frame * (last + 1), spelled(word), std::min(1.0, probability)});
    counts.push_back(phones.size() - before);
  });
  if (piece.words.empty()) return piece;
  piece.phones = align(samples, phones);
  const auto said = static_cast<std::size_t>(
      std::count_if(piece.phones.begin(), piece.phones.end(), [](const auto& phone) { return !phone.symbol.empty(); }));
  if (said == phones.size()) {
    std::size_t at = 0;
    for (std::size_t w = 0; w < piece.words.size(); ++w) {
      while (piece.phones[at].symbol.empty()) ++at;
      piece.words[w].time = piece.phones[at].time;
      for (std::size_t left = counts[w]; left > 0; ++at) left -= piece.phones[at].symbol.empty() ? 0 : 1;
    }
  } else {
    piece.phones = spread(piece.words, phones, counts);
  }
  return piece;
}

std::vector<RecognizedPhone> Recognizer::align(std::span<const std::int16_t> samples,
                                               const std::vector<std::string>& phones) {
  ps_decoder_t* const decoder = phones_.get();
  const auto count = static_cast<int>(phones.size());
  fsg_model_t* const grammar = fsg_model_init("said", ps_get_logmath(decoder), 1.0F, count + 1);
  if (grammar == nullptr) return {};
  grammar->start_state = 0;
  grammar->final_state = count;
  for (int i = 0; i < count; ++i)
    fsg_model_trans_add(grammar, i, i + 1, 0, fsg_model_word_add(grammar, phones[static_cast<std::size_t>(i)].c_str()));
  const bool is_set = ps_set_fsg(decoder, "said", grammar) == 0 && ps_set_search(decoder, "said") == 0;
  fsg_model_free(grammar);  // the decoder holds its own reference
  if (!is_set || !decode(decoder, samples)) return {};
  std::vector<RecognizedPhone> found;
  each_segment(decoder, [&](ps_seg_t* segment, const std::string& word) {
    int first = 0, last = 0;
    ps_seg_frames(segment, &first, &last);
    if (last < first || word == "(NULL)") return;
    found.push_back({ms_per_frame * first, ipa_of(word)});
  });
  return found;
}

}  // namespace semblante::voice
