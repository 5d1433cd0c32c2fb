#include "core/types/printable.h"

#include <gtest/gtest.h>

namespace semblante {
namespace {

TEST(Printable, LettersOfEveryLanguage_Stay) {
  for (const char* text : {"a face", "Jos\u00e9", "\u5934", "\u0631\u0623\u0633", "\u05e8\u05d0\u05e9", "\U0001F600",
                           "\u00a0\u2027\u202f\u2065\u206a"})
    EXPECT_EQ(printable(text), text);
}

TEST(Printable, CharactersThatActOnTheText_BecomeQuestionMarks) {
  for (const char* text :
       {"\n", "\x1b", "\x7f", "\u0080", "\u009b", "\u009f", "\u2028", "\u2029", "\u202e", "\u2066", "\u2069"})
    EXPECT_EQ(printable(std::string("a") + text + "b"), "a?b");
}

TEST(Blank, IsWhatHasNothingToSee) {
  for (const char* text :
       {"", " ", "\u00A0", "\u200B", "\u200D\u200C", " \u2060\uFEFF ", "\u3000", "\u3164", "\uFE0F", "\U000E0020"})
    EXPECT_TRUE(is_blank(text)) << text;
  // Joiners and selectors within what is seen: scripts of Iran and India, and families of emoji, need them.
  for (const char* text : {"a", "\u200Ba", "\u0645\u06CC\u200C\u062E", "\u2764\uFE0F", "\U0001F468\u200D\U0001F469",
                           "\u00E9", "\u2010", "\xff"})
    EXPECT_FALSE(is_blank(text)) << text;
}

TEST(Printable, BytesThatAreNoUtf8_BecomeQuestionMarks) {
  EXPECT_EQ(printable("a\xff"
                      "b\xc2"),
            "a?b?");
  EXPECT_EQ(printable(std::string(300, 'a')), std::string(200, 'a'));
}

}  // namespace
}  // namespace semblante
