#include <gtest/gtest.h>
#include <omnimapper/base/Bytes.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/eval/ObjectTruth.h>
#include <omnimapper/eval/TriangleMesh.h>
#include <omnimapper/testing/Fixtures.h>

#include <cstring>
#include <fstream>

namespace omnimapper::eval::object_truth_test {
namespace {

const std::string kPlaces =
    "object,shape,moveable,mesh,length_m,width_m,height_m,from_s,on,in_motion,x_m,y_m,z_m,qx,qy,qz,qw\n";
const std::string kSightings =
    "stamp,sensor,measurement,object,pixels,depth_pixels,left_px,top_px,right_px,bottom_px,distance_m\n";

class ObjectTruth : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) {
    std::ofstream(folder_ / file, std::ios::binary) << text;
  }
  void expectRefused(const std::string& what, const std::string& words) {
    try {
      const auto objects = readTrueObjects(folder_ / ".");
      countSightings(objects, readObjectSightings(folder_ / "."));
      ADD_FAILURE() << what << " is accepted";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input) << what;
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << what << ": " << error.what();
    }
  }
  testing::ScratchFolder folder_;
};

TEST_F(ObjectTruth, PlacesAreReadInOrderWithWhatCarriesThem) {
  write("objects.csv", kPlaces +
                           "cup,cup,1,objects/cup.ply,0.1,0.08,0.09,0,table/top,0,1,2,0.74,0,0,0,1\n"
                           "\"a,b\",box,0,objects/a_b.ply,0.2,0.1,0.3,0,room/floor,0,3,1,0,0,0,1,0\n"
                           "cup,cup,1,objects/cup.ply,0.1,0.08,0.09,5,anna,1,1,2,0.74,0,0,0,1\n"
                           "cup,cup,1,objects/cup.ply,0.1,0.08,0.09,9.5,,0,,,,,,,\n");
  const auto objects = readTrueObjects(folder_ / ".");
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[1].name, "a,b");
  EXPECT_FALSE(objects[1].moveable);
  EXPECT_NEAR(objects[1].extents.z(), 0.3, 1e-12);
  ASSERT_EQ(objects[0].places.size(), 3u);
  EXPECT_EQ(objects[0].at(-1).on, "table/top");
  EXPECT_EQ(objects[0].at(4.9).on, "table/top");
  EXPECT_TRUE(objects[0].at(5).in_motion);
  EXPECT_EQ(objects[0].at(5).on, "anna");
  EXPECT_FALSE(objects[0].at(20).map_from_object);
  EXPECT_TRUE(objects[1].at(0).map_from_object->translation.isApprox(Eigen::Vector3d(3, 1, 0)));
  EXPECT_TRUE(
      (objects[1].at(0).map_from_object->rotation * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitX()))
      << "qz = 1 is half a turn";
}

TEST_F(ObjectTruth, AnObjectIsSeenIfEnoughImagesShowEnoughOfIt) {
  write("objects.csv", kPlaces +
                           "cup,cup,1,c.ply,0.1,0.08,0.09,0,t/top,0,1,2,0.74,0,0,0,1\n"
                           "box,box,1,b.ply,0.1,0.08,0.09,0,t/top,0,1,2,0.74,0,0,0,1\n"
                           "can,can,1,d.ply,0.1,0.08,0.09,0,t/top,0,1,2,0.74,0,0,0,1\n");
  std::string rows = kSightings;
  for (int i = 0; i < 25; ++i) {
    const std::string begin = "17000000" + std::to_string(10 + i) + ".5,kinect," + std::to_string(i);
    rows += begin + ",cup,300,280,1,2,30,40," + (i < 10 ? "1.2" : "2.5") + "\n";
    rows += begin + ",box,299,0,1,2,30,40,0.9\n";
  }
  write("objects_seen.csv", rows);
  const auto objects = readTrueObjects(folder_ / ".");
  const auto sightings = readObjectSightings(folder_ / ".");
  ASSERT_EQ(sightings.size(), 50u);
  EXPECT_EQ(base::formatUnix(sightings[2].stamp, 1), "1700000011.5");
  EXPECT_EQ(sightings[2].bottom, 40);
  EXPECT_EQ(sightings[2].depth_pixels, 280);
  const auto seen = countSightings(objects, sightings);
  ASSERT_EQ(seen.size(), 3u);
  EXPECT_TRUE(seen[0].is_seen);
  EXPECT_EQ(seen[0].images, 25);
  EXPECT_NEAR(seen[0].nearest, 1.2, 1e-12);
  EXPECT_FALSE(seen[1].is_seen) << "one pixel too few";
  EXPECT_EQ(seen[1].most_pixels, 299);
  EXPECT_FALSE(seen[2].is_seen);
  const auto near = countSightings(objects, sightings, {300, 20, 1.5});
  EXPECT_EQ(near[0].images, 10);
  EXPECT_FALSE(near[0].is_seen);
  EXPECT_NE(table(seen, objects).find("1 of 3 objects were seen"), std::string::npos) << table(seen, objects);
  EXPECT_NE(json(seen, objects).find("\"seen\": 1"), std::string::npos);
  EXPECT_NE(json(seen, objects).find("\"nearest_m\": null"), std::string::npos) << "of the can, which no image shows";
}

TEST_F(ObjectTruth, DamagedTablesAreRefusedWithTheirLine) {
  const std::string cup = "cup,cup,1,c.ply,0.1,0.08,0.09,0,t/top,0,1,2,0.74,0,0,0,1\n";
  expectRefused("no table", "objects.csv");
  write("objects.csv", kPlaces + cup);
  expectRefused("no sightings", "objects_seen.csv");
  write("objects_seen.csv", kSightings + "1700000010.5,kinect,1,vase,300,280,1,2,30,40,1.2\n");
  expectRefused("a sighting of nothing", "'vase'");
  write("objects_seen.csv", kSightings + "1700000010.5,kinect,1,cup,-3,280,1,2,30,40,1.2\n");
  expectRefused("a negative count", "objects_seen.csv:2");
  write("objects_seen.csv", kSightings);
  write("objects.csv", kPlaces + cup + cup);
  expectRefused("two places at once", "objects.csv:3: column from_s");
  write("objects.csv", kPlaces + "cup,cup,1,c.ply,0.1,0.08,0.09,0,t/top,0,1,2,0.74,0,0,0,3\n");
  expectRefused("no rotation", "quaternion");
  write("objects.csv", kPlaces + "cup,cup,1,c.ply,0.1,0.08,0.09,0,t/top,0,1,two,0.74,0,0,0,1\n");
  expectRefused("no number", "'two'");
  write("objects.csv", "object,shape\ncup,cup\n");
  expectRefused("no column", "'moveable'");
}

class TriangleMeshes : public ObjectTruth {
 protected:
  static std::string header(int vertices, int faces, const std::string& more = "") {
    return "ply\nformat binary_little_endian 1.0\ncomment of a test\nelement vertex " + std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\n" + more + "element face " + std::to_string(faces) +
           "\nproperty list uchar int vertex_indices\nend_header\n";
  }
  static std::string vertex(float x, float y, float z) {
    base::ByteWriter writer;
    for (const float value : {x, y, z}) {
      std::uint32_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      writer.uint(bits, 4);
    }
    return writer.take();
  }
  static std::string face(const std::vector<int>& corners) {
    base::ByteWriter writer;
    writer.uint(corners.size(), 1);
    for (const int corner : corners) writer.uint(static_cast<std::uint32_t>(corner), 4);
    return writer.take();
  }
  void expectNoMesh(const std::string& bytes, const std::string& words) {
    write("mesh.ply", bytes);
    try {
      readTriangleMesh(folder_ / "mesh.ply");
      ADD_FAILURE() << words << " is accepted";
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("mesh.ply"), std::string::npos) << error.what();
    }
  }
  const std::string vertices_ = vertex(0, 0, 0) + vertex(1, 0, 0) + vertex(0, 2, 0.5);
};

TEST_F(TriangleMeshes, AreReadWithTheirCorners) {
  write("mesh.ply", header(3, 2) + vertices_ + face({0, 1, 2}) + face({2, 1, 0}));
  const TriangleMesh mesh = readTriangleMesh(folder_ / "mesh.ply");
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3d(0, 2, 0.5));
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[1], (std::array<int, 3>{2, 1, 0}));
}

TEST_F(TriangleMeshes, OtherPropertiesArePassedOver) {
  std::string bytes = header(1, 0, "property uchar red\nproperty double time\n") + vertex(1, 2, 3);
  bytes += '\x07' + std::string(8, '\0');
  write("mesh.ply", bytes);
  EXPECT_EQ(readTriangleMesh(folder_ / "mesh.ply").vertices.front(), Eigen::Vector3d(1, 2, 3));
}

TEST_F(TriangleMeshes, DamagedOnesAreRefused) {
  expectNoMesh("plume", "no PLY");
  expectNoMesh("ply\nformat ascii 1.0\nend_header\n", "binary_little_endian");
  expectNoMesh(header(3, 1) + vertices_, "truncated");
  expectNoMesh(header(3, 1) + vertices_ + face({0, 1, 3}), "corner 3");
  expectNoMesh(header(3, 1) + vertices_ + face({0, 1, -1}), "corner -1");
  expectNoMesh(header(3, 1) + vertices_ + face({0, 1, 2, 0}), "only triangles");
  expectNoMesh(header(3, 0, "property word x\n") + vertices_, "unknown type");
  expectNoMesh(
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nend_header\n" + std::string(4, '\0'),
      "coordinates");
  // An element of nothing takes no time however often it comes.
  write("mesh.ply", "ply\nformat binary_little_endian 1.0\nelement nothing 18446744073709551615\nend_header\n");
  EXPECT_TRUE(readTriangleMesh(folder_ / "mesh.ply").vertices.empty());
}

}  // namespace
}  // namespace omnimapper::eval::object_truth_test
