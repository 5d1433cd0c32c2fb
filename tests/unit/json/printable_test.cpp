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

TEST(Printable, BytesThatAreNoUtf8_BecomeQuestionMarks) {
  EXPECT_EQ(printable("a\xff"
                      "b\xc2"),
            "a?b?");
  EXPECT_EQ(printable(std::string(300, 'a')), std::string(200, 'a'));
}

}  // namespace
}  // namespace semblante
