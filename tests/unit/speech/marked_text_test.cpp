// Marks of emotion in a text.
#include "core/speech/marked_text.h"

#include <gtest/gtest.h>

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
       {"[joy]a", "a[/joy]", "[joy][anger]a[/joy][/anger]", "[joy 2]a[/joy]", "[joy x]a[/joy]"})
    EXPECT_FALSE(read_marked_text(text).ok()) << text;
  EXPECT_NE(read_marked_text("ab[/joy]").error().message.find("byte 2"), std::string::npos);
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
