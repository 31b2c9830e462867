#include <gtest/gtest.h>
#include <omnimapper/base/Bytes.h>

#include <cmath>
#include <limits>

namespace omnimapper::base::bytes_test {
namespace {

TEST(Bytes, NumbersAreLittleEndianWhateverTheMachine) {
  ByteWriter out;
  out.uint(0x0102, 2);
  out.uint(0xA1A2A3A4A5A6A7A8, 8);
  out.real(1);  // 0x3FF0000000000000
  EXPECT_EQ(out.bytes(), std::string("\x02\x01\xA8\xA7\xA6\xA5\xA4\xA3\xA2\xA1\0\0\0\0\0\0\xF0\x3F", 18));
}

TEST(Bytes, EveryBitOfANumberComesBack) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  ByteWriter out;
  for (const double value : {-0.0, 1e-310, 1e308, nothing}) out.real(value);
  out.block("some text");
  ByteReader in(out.bytes(), "test");
  for (const double value : {-0.0, 1e-310, 1e308, nothing}) EXPECT_EQ(bitsOf(in.real()), bitsOf(value));
  EXPECT_EQ(in.block(), "some text");
  EXPECT_TRUE(in.atEnd());
}

TEST(Bytes, AnEndInTheMiddleNamesThePlace) {
  ByteReader in("abc", "a.map");
  in.uint(2);
  try {
    in.uint(4);
    FAIL() << "three bytes are not six";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::unreadable_input);
    EXPECT_NE(std::string(error.what()).find("a.map: truncated: byte 2"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace omnimapper::base::bytes_test
