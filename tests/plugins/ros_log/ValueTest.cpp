#include <gtest/gtest.h>

#include "Serializer.h"
#include "ros_log/ChannelDecoder.h"
#include "ros_log/Value.h"

namespace omnimapper::ros::value_test {
namespace {

using ros_test::Serializer;

const char* const kDefinition =
    "# A message that nobody has.\n"
    "int32 KIND=3\nstring NOTE = with # a hash\n"
    "uint8 kind  # one byte\nfloat64 length\nstring<=20 name\nint16[3] counts\nfloat32[<=4] ranges\nPart[] parts\n"
    "bool is_last false\n"
    "================\nMSG: test_msgs/msg/Part\nstring name\nint8 sign\n";

std::string serialized(bool is_cdr, bool is_big_endian) {
  Serializer out(is_cdr, is_big_endian);
  out.uint(200, 1).real(2.5).text("left").uint(1, 2).uint(0xffff, 2).uint(3, 2);
  out.sequence({0.5F, -1.25F}).uint(2, 4).text("a").uint(0xfe, 1).text("bc").uint(7, 1).uint(1, 1);
  return out.bytes();
}

void expectAllFields(const Value& value) {
  EXPECT_EQ(value["kind"].integer(), 200);
  EXPECT_EQ(value["length"].number(), 2.5);
  EXPECT_EQ(value["name"].text(), "left");
  ASSERT_EQ(value["counts"].size(), 3u);
  EXPECT_EQ(value["counts"].number(1), -1);
  ASSERT_EQ(value["ranges"].size(), 2u);
  EXPECT_EQ(value["ranges"].number(1), -1.25);
  ASSERT_EQ(value["parts"].size(), 2u);
  EXPECT_EQ(value["parts"][0]["sign"].integer(), -2);
  EXPECT_EQ(value["parts"][1]["name"].text(), "bc");
  EXPECT_EQ(value["is_last"].integer(), 1);
  EXPECT_FALSE(value.has("KIND"));
}

TEST(RosValue, isDecodedAsItsDefinitionSays) {
  const Definition definition("test_msgs/Whole", kDefinition);
  const std::string of_ros1 = serialized(false, false);
  expectAllFields(decoded(definition.layout(), of_ros1, Encoding::ros1));
  for (const bool is_big : {false, true}) {
    const std::string bytes = serialized(true, is_big);
    expectAllFields(decoded(definition.layout(), bytes, Encoding::cdr));
  }
}

TEST(RosValue, numbersOfCdrAreAlignedAfterTheHead) {
  // 1 byte, 7 of padding, 8 of a number: worked out by hand.
  const Definition definition("test_msgs/Two", "uint8 a\nfloat64 b\n");
  const std::string bytes = std::string("\0\1\0\0\x05\0\0\0\0\0\0\0", 12) + std::string("\0\0\0\0\0\0\xf0\x3f", 8);
  EXPECT_EQ(decoded(definition.layout(), bytes, Encoding::cdr)["b"].number(), 1.0);
}

TEST(RosValue, timesAreReadOfBothVersions) {
  const Definition of_ros1("test_msgs/T", "time at\nduration for\n");
  const std::string bytes = Serializer(false).uint(3, 4).uint(5, 4).uint(0xffffffff, 4).uint(0, 4).bytes();
  const auto value = decoded(of_ros1.layout(), bytes, Encoding::ros1);
  EXPECT_EQ(value["at"].nanoseconds(), 3'000'000'005);
  EXPECT_EQ(value["for"].nanoseconds(), -1'000'000'000);
  const Definition of_ros2(
      "test_msgs/T", "builtin_interfaces/Time at\n===\nMSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n");
  const std::string cdr = Serializer(true).uint(3, 4).uint(5, 4).bytes();
  EXPECT_EQ(decoded(of_ros2.layout(), cdr, Encoding::cdr)["at"].nanoseconds(), 3'000'000'005);
}

TEST(RosValue, aMessageThatEndsEarlyOrStatesTooMuchIsRefused) {
  const Definition definition("test_msgs/Whole", kDefinition);
  const std::string whole = serialized(false, false);
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_THROW(decoded(definition.layout(), std::string_view(whole).substr(0, size), Encoding::ros1), BadBytes)
        << size;
  const Definition list("test_msgs/List", "test_msgs/Nothing[] all\n===\nMSG: test_msgs/Nothing\n");
  const std::string many = Serializer(false).uint(0xffffffff, 4).bytes();
  EXPECT_THROW(decoded(list.layout(), many, Encoding::ros1), BadBytes);
  EXPECT_THROW(decoded(definition.layout(), std::string("\0\x0b\0\0", 4), Encoding::cdr), BadBytes);
}

TEST(RosValue, arraysWithoutElementsCountAsValues) {
  // 50,000 parts of a byte with a hundred fields each: 5 million values.
  std::string text = "Part[] parts\n===\nMSG: test_msgs/Part\nuint8 a\n";
  for (int i = 1; i < 100; ++i) text += "uint8[0] none" + std::to_string(i) + "\n";
  const Definition definition("test_msgs/List", text);
  const auto listOf = [](std::size_t parts) {
    return Serializer(false).uint(parts, 4).raw(std::string(parts, '\0')).bytes();
  };
  const std::string few = listOf(100), many = listOf(50'000);
  EXPECT_EQ(decoded(definition.layout(), few, Encoding::ros1)["parts"].size(), 100u);
  EXPECT_THROW(decoded(definition.layout(), many, Encoding::ros1), BadBytes);
}

TEST(RosValue, aFieldThatIsMissingIsNamed) {
  const Definition definition("test_msgs/Two", "uint8 a\n");
  const auto value = decoded(definition.layout(), std::string(1, '\1'), Encoding::ros1);
  try {
    value["ranges"];
    FAIL();
  } catch (const BadBytes& bad) {
    EXPECT_NE(std::string(bad.what()).find("no field ranges"), std::string::npos);
  }
  EXPECT_THROW(value["a"].text(), BadBytes);
  EXPECT_THROW(value["a"].size(), BadBytes);
}

TEST(RosDefinition, refusesWhatCannotBeFollowed) {
  EXPECT_THROW(Definition("a/B", "a/C c\n"), BadDefinition);
  EXPECT_THROW(Definition("a/B", "B inner\n"), BadDefinition);
  EXPECT_THROW(Definition("a/B", "wstring text\n"), BadDefinition);
  EXPECT_THROW(Definition("a/B", "int8[x] numbers\n"), BadDefinition);
}

TEST(RosDefinition, ofEveryTypeThatIsReadIsKnownAndLikeThatOfABag) {
  for (const char* type :
       {"sensor_msgs/LaserScan", "sensor_msgs/MultiEchoLaserScan", "sensor_msgs/Imu", "sensor_msgs/NavSatFix",
        "nav_msgs/Odometry", "sensor_msgs/Image", "sensor_msgs/CompressedImage", "sensor_msgs/CameraInfo",
        "sensor_msgs/PointCloud2", "geometry_msgs/PoseStamped", "geometry_msgs/PoseWithCovarianceStamped",
        "tf2_msgs/TFMessage"}) {
    EXPECT_NE(roleOf(type), Role::other) << type;
    EXPECT_FALSE(Definition(type, usualDefinition(type)).layout().fields.empty()) << type;
  }
  const Definition usual("nav_msgs/Odometry", usualDefinition("nav_msgs/Odometry"));
  const std::string bytes = ros_test::odometryBytes(true, 5, "base", {1, 2, 3, 0, 0, 0, 1});
  const auto value = decoded(usual.layout(), bytes, Encoding::cdr);
  EXPECT_EQ(value["pose"]["pose"]["position"]["z"].number(), 3);
  EXPECT_EQ(value["twist"]["twist"]["angular"]["z"].number(), 0.25);
}

TEST(RosDefinition, knowsTheOldNameOfTheHeader) {
  const Definition definition("a/B",
                              "Header header\n===\nMSG: roslib/Header\nuint32 seq\ntime stamp\nstring frame_id\n");
  EXPECT_EQ(definition.layout().fields.at(0).message->fields.size(), 3u);
}

}  // namespace
}  // namespace omnimapper::ros::value_test
