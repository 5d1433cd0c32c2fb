// Marks of emotion in a text.
#include "core/speech/marked_text.h"

#include <gtest/gtest.h>

#include "core/speech/text_breaks.h"

namespace semblante {
namespace {

enum : std::uint8_t { joy = 1, sadness, anger };

MarkedText marked(std::string_view text) {
  const auto read = read_marked_text(text);
  EXPECT_TRUE(read.ok()) << read.error().message;
  return read ? *read : MarkedText{};
}

void expect_span(const MarkedText& text, std::size_t index, int expression, TextRange range) {
  ASSERT_LT(index, text.emotions.size());
  EXPECT_EQ(text.emotions[index].expression, expression);
  EXPECT_EQ(text.emotions[index].range.first, range.first);
  EXPECT_EQ(text.emotions[index].range.count, range.count);
}

TEST(MarkedText, Spans_AreTakenOut_AndMayNest) {
  const auto text = marked("Não [joy 0.5]é [anger]ão[/anger] mau[/joy].");
  EXPECT_EQ(text.text, "Não é ão mau.");
  expect_span(text, 0, joy, {4, 8});
  EXPECT_EQ(text.emotions[0].intensity, 0.5);
  expect_span(text, 1, anger, {6, 2});
}

TEST(MarkedText, Spans_HaveAFormInXml) {
  const auto text =
      marked("Não <emotion name=\"joy\" intensity='0.5'>é [anger]ão[/anger] mau</emotion>. a < b <emotions>");
  EXPECT_EQ(text.text, "Não é ão mau. a < b <emotions>");
  expect_span(text, 0, joy, {4, 8});
  EXPECT_EQ(text.emotions[0].intensity, 0.5);
  expect_span(text, 1, anger, {6, 2});
}

TEST(MarkedText, Smileys_ColourTheSentenceTheyEndOrStandIn) {
  const auto after = marked("Tudo mal. Olá, mundo! :)");
  EXPECT_EQ(after.text, "Tudo mal. Olá, mundo! ");
  expect_span(after, 0, joy, {10, 11});
  const auto within = marked("Oh no :( it rains. Fine.");
  expect_span(within, 0, sadness, {0, 16});
  const auto before = marked("😠 Go away. Please.");
  expect_span(before, 0, anger, {0, 9});
  EXPECT_TRUE(marked("At 10:D4, note (a:b) and fox:Dog.").emotions.empty());
}

TEST(MarkedText, OtherBrackets_AreText) {
  EXPECT_EQ(marked("a [note] b [/x]").text, "a [note] b [/x]");
  EXPECT_TRUE(marked("neutral").emotions.empty());
}

TEST(MarkedText, BrokenMarks_AreErrorsWithTheirPlace) {
  for (const char* const text :
       {"[joy]a", "a[/joy]", "[joy][anger]a[/joy][/anger]", "[joy 2]a[/joy]", "[joy x]a[/joy]", "<emotion name='joy'>a",
        "a</emotion>", "[joy]<emotion name='anger'>a[/joy]</emotion>", "<emotion name='bored'>a</emotion>",
        "<emotion name='joy' intensity='x'>a</emotion>", "<emotion name='joy'/>a",
        "<emotion name='joy' id='x'>a</emotion>", "<emotion", "<emotion name='joy"})
    EXPECT_FALSE(read_marked_text(text).ok()) << text;
  EXPECT_NE(read_marked_text("\xC3[joy]\xA9[/joy]").error().message.find("not UTF-8 (byte 0)"), std::string::npos);
  EXPECT_NE(read_marked_text("ab[/joy]").error().message.find("byte 2"), std::string::npos);
}

TEST(MarkedText, SpansNestSixteenDeep) {
  const auto nested = [](std::size_t depth) {
    std::string text = "a";
    for (std::size_t i = 0; i < depth; ++i)
      text = i % 2 == 0 ? "[joy]" + text + "[/joy]" : "<emotion name='anger'>" + text + "</emotion>";
    return text;
  };
  EXPECT_EQ(read_marked_text(nested(max_nested_spans))->emotions.size(), max_nested_spans);
  const auto deeper = read_marked_text(nested(max_nested_spans + 1));
  ASSERT_FALSE(deeper.ok());
  EXPECT_EQ(deeper.error().where, "text");
  EXPECT_NE(deeper.error().message.find("nest deeper than 16"), std::string::npos);
}

TEST(MarkedText, FirstPart_IsTheFirstSentences_AndBothKeepTheirMarks) {
  const auto parts = [](std::string_view text) {
    const auto cut = first_part(text);
    EXPECT_TRUE(cut.ok()) << cut.error().message;
    return cut ? std::pair(cut->first, cut->rest) : std::pair<std::string, std::string>();
  };
  using Both = std::pair<std::string, std::string>;
  EXPECT_EQ(parts("Short. Also. "), Both("Short. Also. ", ""));
  EXPECT_EQ(parts("Oi. This one is long enough to be heard alone?! :) And more."),
            Both("Oi. This one is long enough to be heard alone?! :) ", "And more."));
  EXPECT_EQ(
      parts("[joy 0.5]<emotion name='anger'>This one is long enough to be heard alone. And</emotion> more.[/joy] End"),
      Both("[joy 0.5]<emotion name='anger'>This one is long enough to be heard alone. </emotion>[/joy]",
           "[joy 0.5]<emotion name='anger'>And</emotion> more.[/joy] End"));
  EXPECT_EQ(parts("[joy]This one is long enough to be heard alone.[/joy] End").first,
            "[joy]This one is long enough to be heard alone.[/joy] ");
  // Without sentences: at a clause, then at any space or sign, then anywhere, but not within a number or an entity.
  std::string clauses;
  for (int i = 0; i < 30; ++i) clauses += "seven words that end with, ";
  const auto [clause, others] = parts(clauses);
  EXPECT_TRUE(clause.ends_with("with, ")) << clause;
  EXPECT_EQ(clause + others, clauses);
  std::string words;
  for (int i = 0; i < 300; ++i) words += "\u00E1 ";
  EXPECT_EQ(parts(words).first.size(), 3U * 160U) << "320 characters";
  EXPECT_EQ(parts(std::string(900, 'a')).first.size(), most_part_letters);
  std::string letters;
  for (int i = 0; i < 400; ++i) letters += "a.";
  EXPECT_EQ(parts(letters).first.size(), long_part_letters);
  EXPECT_EQ(parts("Version 3.5 of www.example.com is, as far as anybody knows, not a long text").second, "");
  EXPECT_EQ(parts(std::string(330, '1') + ".5 and more").first, std::string(330, '1') + ".5 ");
  EXPECT_EQ(parts(std::string(160, 'a') + ", but then").second, "but then");
  EXPECT_FALSE(first_part("a[/joy]").ok());
}

TEST(MarkedText, FirstPart_EndsAtTheSignsOfOtherScripts) {
  const auto first = [](const std::string& text) {
    const auto cut = first_part(text);
    return cut ? cut->first : cut.error().message;
  };
  const auto repeated = [](const char* text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  };
  const std::string chinese = repeated("今", 45) + "。", greek = repeated("α", 45) + "… ";
  EXPECT_EQ(first(chinese + "今天"), chinese);
  EXPECT_EQ(first(greek + "α"), greek);
  // They are said as slowly as some letters, or spelled by a voice of another language.
  const std::string clause = repeated("今", 30) + "，";
  EXPECT_EQ(first(clause + repeated("今", 100)), clause);
  EXPECT_EQ(first(repeated("ก", 1000)), repeated("ก", 12));
  EXPECT_EQ(first(repeated("ก", 9) + " " + repeated("ก", 60)), repeated("ก", 9) + " ");
  // A text is not cut between a letter and its vowel or tone, unless it has nothing but vowels.
  EXPECT_EQ(first(repeated("ก", 11) + "ดี" + repeated("ม", 60)), repeated("ก", 11) + "ดี");
  EXPECT_EQ(first(repeated("ี", 1000)), repeated("ี", 24));
  for (const char* letter : {"ກ", "བ", "ሀ", "ក"}) EXPECT_EQ(first(repeated(letter, 1000)), repeated(letter, 12));
  for (const char* letter : {"Ꭰ", "あ", "한", "မ", "ა"}) EXPECT_EQ(first(repeated(letter, 1000)), repeated(letter, 80));
  EXPECT_EQ(first(repeated("अ", 1000)), repeated("अ", 480));
  EXPECT_EQ(first(repeated("ạ", 1000)), repeated("ạ", 480));
}

TEST(MarkedText, Prosody_FollowsTheShareOfTheText) {
  EXPECT_EQ(prosody_of(marked("Hello.")).rate, 1.0);
  const double all = prosody_of(marked("[sadness]Hello there.[/sadness]")).rate;
  const double half = prosody_of(marked("[sadness]Hello [/sadness]there.")).rate;
  EXPECT_LT(all, half);
  EXPECT_LT(half, 1.0);
}

}  // namespace
}  // namespace semblante
