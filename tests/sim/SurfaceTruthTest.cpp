// The parts of a world's flat surfaces that a log shows.
#include <gtest/gtest.h>
#include <omnimapper/sim/SimulationRun.h>
#include <omnimapper/sim_world/WorldIni.h>
#include <omnimapper/testing/Fixtures.h>

#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "CameraFixture.h"
#include "MeshFile.h"
#include "SurfaceTruth.h"

namespace surface_truth_test {
namespace {

using namespace omnimapper;
using Eigen::Vector3d;
using sim::CameraFixture;
using surfaces::CellGrid;

geometry::Se3 pose(double x, double y, double z, double yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Vector3d::UnitZ())), {x, y, z}};
}

/// The cells of a surface that the first measurement of a sensor sees.
CellGrid seenOf(CameraFixture& fixture, const std::string& ini, const std::string& name) {
  const auto sensor = fixture.make(ini);
  sim::SurfaceTruth truth(fixture.world);
  truth.add(sensor->measure(0).seen, sensor->timeOf(0));
  for (const auto& surface : truth.surfaces("place").surfaces) {
    if (surface.name == name) return *surface.seen;
  }
  throw std::runtime_error("no surface " + name);
}

// 160 x 120 pixels at a focal length of 100: 1.6 x 1.2 m at 1 m.
const std::string kCamera =
    "RgbdCamera\nmodel = ideal\nwidth_px = 160\nheight_px = 120\nfocal_px = 100\n"
    "colour_focal_px = 100\ncolour = false\n";

TEST(SurfaceTruth, aCameraSeesTheRectangleOfAWallThatIsInItsPictureAndNothingBehindIt) {
  CameraFixture fixture;
  fixture.addBoard("wall", 2, 0, 0, 8, 8);
  fixture.addBoard("behind", 3, 0, 0, 8, 8);
  const CellGrid seen = seenOf(fixture, kCamera, "wall");
  EXPECT_NEAR(seen.area(), 3.2 * 2.4, (3.2 + 2.4) * 2 * 0.05);
  for (const auto& [y, z, is_in] : {std::tuple(1.55, 1.15, true),
                                    {-1.55, -1.15, true},
                                    {0.02, 0.02, true},
                                    {1.7, 0.0, false},
                                    {0.0, 1.3, false},
                                    {-1.7, 0.0, false}})
    EXPECT_EQ(seen.isSet(*seen.cellAt({2, y, z})), is_in) << y << " " << z;
  EXPECT_EQ(seenOf(fixture, kCamera, "behind").count(), 0u);
}

TEST(SurfaceTruth, aRealCameraSeesNearlyTheSameOfItAlsoWhereDepthIsRegistered) {
  CameraFixture fixture;
  fixture.addBoard("wall", 2, 0, 0, 8, 8);
  const double whole = 2 * 640 / 580.0 * 2 * 480 / 580.0;
  for (const std::string registered : {"true", "false"}) {
    const double area =
        seenOf(fixture, "RgbdCamera\nmodel = kinect\ncolour = false\nregistered = " + registered, "wall").area();
    EXPECT_GT(area, 0.8 * whole) << registered;
    EXPECT_LT(area, 1.2 * whole) << registered;
  }
}

TEST(SurfaceTruth, aCameraThatTurnsSeesWhatItsDepthsAreOfNotWhatItsLaterPictureShows) {
  const auto seenWith = [](const std::string& delay) {
    CameraFixture fixture;
    fixture.map_from_base = sim::Track(sim::Track::Kind::motion, {{0, pose(0, 0, 0, 0)}, {1, pose(0, 0, 0, 1)}});
    fixture.addBoard("wall", 2, 0, 0, 8, 8);
    return seenOf(fixture, "RgbdCamera\nmodel = kinect\ncolour_delay_s = " + delay, "wall");
  };
  const CellGrid at_once = seenWith("0"), late = seenWith("0.3");
  ASSERT_GT(at_once.count(), 1000u);
  EXPECT_EQ(late.count(), at_once.count());
  for (int row = 0; row < late.rows(); ++row) {
    for (int column = 0; column < late.columns(); ++column)
      ASSERT_EQ(late.isSet({column, row}), at_once.isSet({column, row})) << column << " " << row;
  }
}

TEST(SurfaceTruth, nothingIsSeenFromBeyondFourMetres) {
  CameraFixture far, near;
  far.addBoard("wall", 4.05, 0, 0, 8, 8);
  EXPECT_EQ(seenOf(far, kCamera, "wall").count(), 0u);
  // A ball with a radius of 4 m cuts a disc out of a plane at 3.8 m.
  near.addBoard("wall", 3.8, 0, 0, 8, 8);
  const double radius = std::sqrt(4 * 4 - 3.8 * 3.8);
  EXPECT_NEAR(seenOf(near, kCamera, "wall").area(), M_PI * radius * radius, 2 * M_PI * radius * 0.05);
}

TEST(SurfaceTruth, nothingIsSeenAtAnIncidenceAboveSeventyFiveDegrees) {
  // Rays of this camera are up to 4.6 deg from its axis.
  const std::string narrow =
      "RgbdCamera\nmodel = ideal\nwidth_px = 160\nheight_px = 120\nfocal_px = 1000\n"
      "colour_focal_px = 1000\ncolour = false\n";
  for (const auto& [degrees, is_seen] : {std::pair(80.0, false), {69.0, true}}) {
    CameraFixture fixture;
    fixture.addFacing("wall", sim::SurfaceKind::wall, pose(2, 0, 0, degrees * M_PI / 180), 8, 8);
    EXPECT_EQ(seenOf(fixture, narrow, "wall").count() > 0, is_seen) << degrees;
  }
}

TEST(SurfaceTruth, aLaserSeesALineOfEachWall) {
  CameraFixture fixture;
  fixture.addBoard("wall", 1, 0, 0, 2, 2);
  const CellGrid seen = seenOf(fixture, "Laser2d\nmodel = ideal\nz_m = 0.02", "wall");
  EXPECT_EQ(seen.count(), 40u);
  EXPECT_TRUE(seen.isSet(*seen.cellAt({1, 0.97, 0.02})));
  EXPECT_FALSE(seen.isSet(*seen.cellAt({1, 0.97, 0.07})));
}

TEST(SurfaceTruth, ofABodyThatIsCarriedTheyAreInTheBody) {
  CameraFixture fixture;
  sim::MeshBuilder builder("box",
                           sim::Track(sim::Track::Kind::steps, {{0, pose(2, 0, 0, 0)}, {5, pose(0, 2, 0, M_PI / 2)}}));
  builder.addBox(builder.addSurface("", sim::SurfaceKind::object, {}), {-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  fixture.world.bodies.push_back(builder.build());
  sim::SurfaceTruth truth(fixture.world);
  // A sensor that looks along y at 6 s hits the -x side of the body.
  truth.add({{0, {0.11f, 1.5f, 0.12f}}}, 6);
  int count = 0;
  for (const auto& surface : truth.surfaces("place").surfaces) {
    EXPECT_TRUE(surface.is_moved);
    count += static_cast<int>(surface.seen->count());
    if (surface.seen->count() == 0) continue;
    // The surface is given where it is at time 0.
    EXPECT_LT((surface.plane.normal + Vector3d::UnitX()).norm(), 1e-9);
    EXPECT_TRUE(surface.seen->isSet(*surface.seen->cellAt({1.5, -0.11, 0.12})));
  }
  EXPECT_EQ(count, 1);
}

/// A PLY file of this program, read back.
struct Mesh {
  std::vector<Eigen::Vector3f> vertices;
  struct Face {
    std::array<std::int32_t, 3> corners;
    std::int32_t surface;
    std::uint8_t is;
  };
  std::vector<Face> faces;
  std::string header;
};

Mesh readPly(const std::string& ply) {
  Mesh mesh;
  const std::size_t body = ply.find("end_header\n") + 11;
  mesh.header = ply.substr(0, body);
  std::istringstream lines(mesh.header);
  std::size_t vertices = 0, faces = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("element vertex ", 0) == 0) vertices = std::stoul(line.substr(15));
    if (line.rfind("element face ", 0) == 0) faces = std::stoul(line.substr(13));
  }
  const char* at = ply.data() + body;
  EXPECT_EQ(ply.size(), body + 12 * vertices + 18 * faces);
  const auto take = [&](auto& value) {
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
  };
  mesh.vertices.resize(vertices);
  for (auto& vertex : mesh.vertices) {
    for (int axis = 0; axis < 3; ++axis) take(vertex[axis]);
  }
  mesh.faces.resize(faces);
  for (auto& face : mesh.faces) {
    std::uint8_t count = 0;
    take(count);
    EXPECT_EQ(count, 3);
    for (auto& corner : face.corners) take(corner);
    take(face.surface);
    take(face.is);
  }
  return mesh;
}

TEST(SurfaceTruth, theMeshHasTheAreaOfTheSurfacesInEachClass) {
  sim::World world = sim::readWorld(base::Config::fromText(
      "[world]\nrooms = hall, kitchen\ndoors = door\nfurniture = wardrobe\n"
      "[hall]\nclass = room\nrectangle_m = 0 0 4 3\n[kitchen]\nclass = room\nrectangle_m = 4.2 0 7 3\n"
      "[door]\nclass = door\nrooms = hall, kitchen\nx_m = 4\ny_m = 1.5\n"
      "[wardrobe]\nclass = wardrobe\nx_m = 1.5\ny_m = 0.3\n",
      "two.ini"));
  sim::MeshBuilder absent("absent", sim::Track(sim::Track::Kind::steps, {{0, std::nullopt}, {1, geometry::Se3{}}}));
  absent.addBox(absent.addSurface("", sim::SurfaceKind::object, {}), {0, 0, 0}, {1, 1, 1});
  world.bodies.push_back(absent.build());
  std::ostringstream ply;
  sim::writeMesh(ply, world);
  std::map<surfaces::SurfaceClass, double> of_surfaces, of_mesh;
  for (const auto& surface : sim::SurfaceTruth(world).surfaces("two").surfaces) {
    of_surfaces[surface.is] += surfaces::areaOf(surface);
    EXPECT_NE(surface.body, "absent") << "it is nowhere at time 0";
  }
  const Mesh mesh = readPly(ply.str());
  const auto refs = sim::numberSurfaces(world);
  for (const auto& face : mesh.faces) {
    const auto& [a, b, c] = face.corners;
    const auto corner = [&](int i) { return mesh.vertices.at(static_cast<std::size_t>(i)).cast<double>().eval(); };
    const double area = (corner(b) - corner(a)).cross(corner(c) - corner(a)).norm() / 2;
    const auto is = surfaces::allSurfaceClasses().at(face.is);
    of_mesh[is] += area;
    const sim::SurfaceRef ref = refs.at(static_cast<std::size_t>(face.surface) - 1);
    EXPECT_EQ(world.bodies[static_cast<std::size_t>(ref.body)].surfaces[static_cast<std::size_t>(ref.surface)].is, is);
  }
  // Narrow surfaces, as the edges of the door's leaf of 0.04 m, are only in the mesh.
  for (const auto& [is, area] : of_mesh)
    EXPECT_NEAR(of_surfaces[is], area, is == surfaces::SurfaceClass::door ? 0.08 : 1e-4) << surfaces::toString(is);
  EXPECT_NE(mesh.header.find("comment class 4: door frame\n"), std::string::npos) << mesh.header;
}

class SurfacesOfARun : public ::testing::Test {
 protected:
  /// surfaces.json of a run through a room of 5 x 4 m.
  std::string run(const std::string& folder, int threads, const std::string& laser = "",
                  const std::function<bool()>& stop = {}) {
    const sim::Simulation simulation(base::Config::fromText(
        "[simulation]\nsensors = laser, camera\nduration_s = 3\n"
        "[world]\nrooms = hall\nfurniture = table_1\n[hall]\nclass = room\nrectangle_m = 0 0 5 4\n"
        "[table_1]\nclass = table\nx_m = 2.5\ny_m = 3.3\n"
        "[robot]\nmode = waypoints\nstart = 1 1\nwaypoints = 1 1, 4 1\n"
        "[laser]\nclass = Laser2d\nz_m = 0.4\nrate_hz = 10\n" +
            laser +
            "[camera]\nclass = RgbdCamera\nwidth_px = 160\nheight_px = 120\nz_m = 1\n"
            "rate_hz = 2\n",
        "room.ini"));
    base::Progress progress;
    path_ = scratch_ / folder;
    const auto result = sim::runSimulation(simulation, {path_, "room", threads}, progress, stop);
    EXPECT_EQ(result.code, stop ? base::ExitCode::interrupted : base::ExitCode::ok);
    return read("surfaces.json");
  }
  std::string read(const std::string& file) const {
    std::ifstream in(path_ + "/" + file, std::ios::binary);
    EXPECT_TRUE(in.is_open()) << file;
    std::ostringstream bytes;
    bytes << in.rdbuf();
    return bytes.str();
  }
  double seenArea() const {
    double area = 0;
    for (const auto& surface : surfaces::readSurfaces(path_ + "/surfaces.json").surfaces) area += surface.seen->area();
    return area;
  }

  omnimapper::testing::ScratchFolder scratch_;
  std::string path_;
};

TEST_F(SurfacesOfARun, doNotDependOnTheNumberOfThreads) {
  const std::string one = run("one", 1), mesh = read("world.ply");
  EXPECT_GT(seenArea(), 5);
  EXPECT_TRUE(one == run("two", 2));
  EXPECT_TRUE(mesh == read("world.ply"));
  const auto set = surfaces::readSurfaces(path_ + "/surfaces.json");
  EXPECT_EQ(set.title, "room");
  for (const auto& surface : set.surfaces) EXPECT_LE(surface.seen->area(), 1.3 * surfaces::areaOf(surface) + 0.3);
}

TEST_F(SurfacesOfARun, areSeenOnlyByMeasurementsThatCameIntoTheLog) {
  run("whole", 1);
  const double whole = seenArea();
  run("lost", 1, "dropout = 1\n");
  EXPECT_LT(seenArea(), whole);
  EXPECT_GT(seenArea(), 0);
  run("interrupted", 1, "", [count = 0]() mutable { return ++count > 1; });
  EXPECT_LT(seenArea(), 0.1 * whole) << "measurements that were made ahead do not count";
  EXPECT_EQ(read("world.ply").substr(0, 4), "ply\n");
}

}  // namespace
}  // namespace surface_truth_test
