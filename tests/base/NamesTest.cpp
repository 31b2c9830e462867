#include <gtest/gtest.h>
#include <omnimapper/base/Config.h>
#include <omnimapper/base/Names.h>

#include <random>
#include <string>

namespace omnimapper::base::names_test {
namespace {

TEST(Names, WhatMovesTheCursorOrBreaksTheLineIsPrintedAsItsBytes) {
  EXPECT_EQ(printable("laser_1"), "laser_1");
  EXPECT_EQ(printable("Küche 台所"), "Küche 台所");
  EXPECT_EQ(printable("a\nb\tc\r"), "a\\x0ab\\x09c\\x0d");
  EXPECT_EQ(printable("\x1b[31mr\x07"), "\\x1b[31mr\\x07");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "C1 has escapes of its own";
  EXPECT_EQ(printable("a\xe2\x80\xae"
                      "b"),
            "a\\xe2\\x80\\xaeb")
      << "U+202E turns the direction of writing";
  EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
  EXPECT_EQ(printableLines("a\nb\x1b"), "a\nb\\x1b");
}

TEST(Names, WhatIsNoUtf8IsPrintedAsItsBytes) {
  EXPECT_EQ(printable("\xff"), "\\xff");
  EXPECT_EQ(printable("a\xc3"), "a\\xc3") << "cut";
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "longer than need be";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a surrogate";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond Unicode";
}

TEST(Names, PrintableTextIsLeftAsItIs) {
  std::mt19937 rng(1);
  for (int i = 0; i < 20000; ++i) {
    std::string text(rng() % 12, ' ');
    for (char& c : text) c = static_cast<char>(rng() % 4 == 0 ? rng() % 32 : rng() % 256);
    const std::string once = printable(text);
    EXPECT_EQ(printable(once), once);
  }
}

// Any text that fitsIni() accepts is read back unchanged, and adds no other key.
TEST(Names, WhatFitsAnIniIsReadBack) {
  EXPECT_TRUE(fitsIni("laser 1"));
  for (const char* text : {"a\nplugin_libraries = x.so", "a ; b", "#a", "//a", "a // b", " a", "a ", "a,b",
                           "$env{HOME}", "a\rb", "\x1b"}) {
    EXPECT_FALSE(fitsIni(text)) << text;
  }
  const std::string characters = "ab1 ;#/,$@{}[]=\\\"'\n\r\t%<>&*?.\x80\xc3\xa9";
  std::mt19937 rng(1);
  int tried = 0;
  for (int i = 0; i < 100000; ++i) {
    std::string text(1 + rng() % 8, ' ');
    for (char& c : text) c = characters[rng() % characters.size()];
    if (!fitsIni(text)) continue;
    ++tried;
    const auto config = Config::fromText("[a]\nkey = " + text + "\nother = 1\n", "test");
    std::string read, other;
    ASSERT_TRUE(config.section("a").find("key", read)) << text;
    EXPECT_EQ(read, text);
    ASSERT_TRUE(config.section("a").find("other", other)) << text;
    EXPECT_EQ(other, "1") << text;
    if (text.find(' ') != std::string::npos) continue;
    EXPECT_EQ(option_text::parseList(text), std::vector<std::string>{text});
  }
  EXPECT_GT(tried, 1000);
}

TEST(Names, TheNameOfASensorIsShortAndStaysItsOwn) {
  EXPECT_EQ(sensorName("laser\n1"), "laser\\x0a1");
  const std::string at_most(200, 'a'), longer(20'000, 'a'), other = longer.substr(1) + "b";
  EXPECT_EQ(sensorName(at_most), at_most);
  EXPECT_LE(sensorName(longer).size(), 200U);
  EXPECT_NE(sensorName(longer), sensorName(other)) << "they begin alike";
  EXPECT_NE(sensorName(longer).find("(20000 bytes, "), std::string::npos) << sensorName(longer);
  EXPECT_EQ(sensorName(sensorName(longer)), sensorName(longer));
  std::string letters;
  for (int i = 0; i < 100; ++i) letters += "\u00fc\u53f0";
  EXPECT_EQ(printable(sensorName(letters)), sensorName(letters)) << "cut between letters";
}

TEST(Names, AFileNameStaysInItsFolder) {
  EXPECT_EQ(asFileName("kinect-1_a.b"), "kinect-1_a.b");
  EXPECT_EQ(asFileName("../../x"), "_.._.._x");
  EXPECT_EQ(asFileName("/etc/passwd"), "_etc_passwd");
  EXPECT_EQ(asFileName(".."), "_..");
  EXPECT_EQ(asFileName(""), "_");
  EXPECT_EQ(asFileName("a\nb"), "a_b");
}

}  // namespace
}  // namespace omnimapper::base::names_test
