#include <gtest/gtest.h>
#include <omnimapper/base/Bytes.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/ObjectMap.h>
#include <omnimapper/testing/Fixtures.h>

#include <filesystem>
#include <fstream>

namespace omnimapper::eval::object_map_test {
namespace {

const std::string kObject =
    R"({"id":"0-12","state":"present","label":"object","box":{"middle":[1,2,0.8],"map_from_box":[1,0,0,0],)"
    R"("size":[0.2,0.1,0.3]},"points":2,"views":1,"seen_in":7,"hidden_in":0,"absent_in":0,"first_seen":1.5,)"
    R"("last_seen":2.5,"last_looked":3.5,"on":null,"model":"objects/0-12.ply","picture":null})";

std::string listOf(const std::string& objects) {
  return R"({"schema":"omnimapper-objects","version":1,"map":"test","merged":3,"objects":[)" + objects + "]}";
}

class ObjectMaps : public ::testing::Test {
 protected:
  ObjectMaps() {
    std::filesystem::create_directory(std::string(folder_ / "objects"));
    const std::string header =
        "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
        "end_header\n";
    write("objects/0-12.ply", header + std::string(24, '\0'));
  }
  void write(const std::string& file, const std::string& text) {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  void expectRefused(const std::string& text, const std::string& words) {
    write("objects.json", text);
    try {
      readObjectMap(folder_ / ".");
      ADD_FAILURE() << text << " is accepted";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  static std::string with(const std::string& part, const std::string& other) {
    std::string text = kObject;
    return listOf(text.replace(text.find(part), part.size(), other));
  }
  testing::ScratchFolder folder_;
};

TEST_F(ObjectMaps, AreReadWithTheirModels) {
  write("objects.json", listOf(kObject));
  const ObjectMap map = readObjectMap(folder_ / ".");
  EXPECT_EQ(map.merged, 3);
  ASSERT_EQ(map.objects.size(), 1U);
  const MappedObject& object = map.objects[0];
  EXPECT_EQ(object.id, "0-12");
  EXPECT_EQ(object.state, MappedObject::State::present);
  EXPECT_EQ(object.map_from_box.translation, Eigen::Vector3d(1, 2, 0.8));
  EXPECT_EQ(object.box_size, Eigen::Vector3d(0.2, 0.1, 0.3));
  EXPECT_EQ(object.seen_in, 7);
  EXPECT_EQ(object.last_looked, 3.5);
  EXPECT_EQ(object.points.size(), 2U);
  write("objects.json", listOf(""));
  EXPECT_TRUE(readObjectMap(folder_ / ".").objects.empty());
}

TEST_F(ObjectMaps, DamagedOnesAreRefused) {
  EXPECT_THROW(readObjectMap(folder_ / "none"), base::Error);
  expectRefused("", "objects.json");
  expectRefused(listOf(kObject).substr(0, 100), "objects.json");
  expectRefused("[1, 2]", "objects.json");
  expectRefused(R"({"schema":"something","version":1,"objects":[]})", "is no list of objects");
  expectRefused(R"({"schema":"omnimapper-objects","version":2,"objects":[]})", "version 1");
  expectRefused(with("present", "asleep"), "object 1: the state 'asleep'");
  expectRefused(with("[1,2,0.8]", "[1,2]"), "has not 3 numbers");
  expectRefused(with("[1,0,0,0]", "[1,1,0,0]"), "quaternion");
  expectRefused(with("\"seen_in\":7,", ""), "seen_in");
  expectRefused(with("\"seen_in\":7,", "\"seen_in\":-7,"), "negative");
  expectRefused(with("objects/0-12.ply", "objects/../../0-12.ply"), "not in the folder");
  expectRefused(with("objects/0-12.ply", "/0-12.ply"), "not in the folder");
  expectRefused(with("0.8", "1e999"), "overflow");
  expectRefused(with("objects/0-12.ply", "objects/none.ply"), "none.ply");
  write("objects/0-12.ply", "ply");
  expectRefused(listOf(kObject), "0-12.ply");
}

}  // namespace
}  // namespace omnimapper::eval::object_map_test
