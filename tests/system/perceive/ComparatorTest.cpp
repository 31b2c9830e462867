// The effect of [planes] comparator on the planes that omnimapper-perceive finds, on simulated posters and sheets of
// paper.
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/obs/CObservationPlanes.h>
#include <omnimapper/perception/PlaneExtractor.h>

#include <algorithm>

#include "../../sim/CameraFixture.h"
#include "PerceiveRuns.h"

namespace {

using namespace perceived;
using omnimapper::obs::CObservationPlanes;
using omnimapper::obs::ObservedPlane;
namespace perception = omnimapper::perception;
namespace sim = omnimapper::sim;

/// A sheet of paper on the wall: its middle, to the left and up [m], its size [m] and its colour.
struct Sheet {
  double left, up, width, height;
  Eigen::Vector3f colour;
};
const std::vector<Sheet> kSheets{{0.5, 0.2, 0.42, 0.594, {0.8F, 0.1F, 0.1F}},
                                 {-0.2, 0.25, 0.594, 0.42, {0.1F, 0.25F, 0.7F}},
                                 {0.1, -0.35, 0.5, 0.3, {0.9F, 0.85F, 0.2F}}};

/// Planes that are found in an image of a wall with sheets of paper, 2 m in front of a camera at a height of 1 m.
std::shared_ptr<const CObservationPlanes> planesOfSheets(const std::string& camera,
                                                         const perception::PlaneComparison& comparison) {
  sim::CameraFixture fixture;
  fixture.addBoard("wall", 2, 0, 1, 6, 4, {{0.75F, 0.75F, 0.72F}, nullptr, 0.7F, 0});
  for (const Sheet& sheet : kSheets)
    fixture.addBoard("sheet", 1.9995, sheet.left, 1 + sheet.up, sheet.width, sheet.height,
                     {sheet.colour, nullptr, 0.7F, 0});
  const auto observation = fixture.make("RgbdCamera\nz_m = 1\n" + camera)->measure(0).observation;
  perception::PlaneComparisonOptions options;
  options.comparison = &comparison;
  const perception::PlaneExtractor extractor({}, {}, options);
  return extractor.extract(dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*observation));
}

double areaOf(const ObservedPlane& plane) {
  double area = omnimapper::geometry::area(plane.outline);
  for (const auto& hole : plane.holes) area -= omnimapper::geometry::area(hole);
  return area;
}

class SheetsOnAWall : public ::testing::TestWithParam<const char*> {};

TEST_P(SheetsOnAWall, AreOnePlaneWithItAndByColourOneEach) {
  EXPECT_EQ(planesOfSheets(GetParam(), perception::kSamePlane)->planes.size(), 1U);
  const auto found = planesOfSheets(GetParam(), perception::kSamePlaneAndColour);
  ASSERT_EQ(found->planes.size(), 1 + kSheets.size());
  EXPECT_EQ(found->planes[0].holes.size(), kSheets.size()) << "the wall has a hole at each sheet";
  const auto base_from_sensor = omnimapper::geometry::fromMrpt(found->sensorPose);
  for (const Sheet& sheet : kSheets) {
    const auto offOf = [&](const ObservedPlane& plane) {
      return (base_from_sensor * plane.centroid - Eigen::Vector3d(2, sheet.left, 1 + sheet.up)).norm();
    };
    const auto nearest = std::min_element(found->planes.begin() + 1, found->planes.end(),
                                          [&](const auto& a, const auto& b) { return offOf(a) < offOf(b); });
    EXPECT_LT(offOf(*nearest), 0.02);
    EXPECT_NEAR(areaOf(*nearest), sheet.width * sheet.height, 0.06 * sheet.width * sheet.height);
    EXPECT_GT(std::abs(nearest->plane_in_sensor.normal.x()), 0.999);
  }
}

// The second gives depths in the frame of its depth camera, which is 2.5 cm beside the colour camera.
INSTANTIATE_TEST_SUITE_P(Cameras, SheetsOnAWall,
                         ::testing::Values("model = kinect\nregistered = true", "model = kinect\nregistered = false",
                                           "model = ideal"));

/// A robot stands in front of a wall with two red plates, which mark fire extinguishers.
const std::string kGallery = R"([simulation]
sensors = kinect
duration_s = 1
[world]
rooms = room
posters = extinguisher_1, extinguisher_2
[room]
class = room
rectangle_m = 0 0 4 4
[extinguisher_1]
class = extinguisher
x_m = 3.9
y_m = 1.6
z_m = 1.3
width_m = 0.4
height_m = 0.5
[extinguisher_2]
class = extinguisher
x_m = 3.9
y_m = 2.4
z_m = 1.3
width_m = 0.4
height_m = 0.5
[robot]
mode = still
start = 1.8 2 0
[kinect]
class = RgbdCamera
model = kinect
z_m = 1.3
rate_hz = 2
)";

class Comparator : public ::testing::Test {
 protected:
  // Number of planes on the wall in each frame.
  std::vector<std::size_t> countOnWall(Texts more) {
    more.insert(more.end(), {"--set", "perception.extractors=planes"});
    more.insert(more.end(), {"--set", "planes.min_pixels=3000"});  // more than the white parts of the red plates
    EXPECT_TRUE(endedWith(ExitCode::ok, perceive(log_, scratch_ / "derived.rawlog", more)));
    std::vector<std::size_t> counts;
    for (const auto& frame : ofClass<CObservationPlanes>(readLog(scratch_ / "derived.rawlog"))) {
      counts.push_back(0);
      const auto base_from_sensor = omnimapper::geometry::fromMrpt(frame->sensorPose);
      for (const auto& plane : frame->planes) {
        const auto in_base = base_from_sensor * plane.plane_in_sensor;
        counts.back() += in_base.normal.x() < -0.99 && std::abs(in_base.distance - 2.2) < 0.05;
      }
    }
    return counts;
  }
  void simulate(const std::string& more = "") {
    writeFile(scratch_ / "gallery.ini", kGallery + more);
    ASSERT_TRUE(endedWith(ExitCode::ok, runProgram({omnimapper::testing::ownProgram("omnimapper-simulate"), "-i",
                                                    scratch_ / "gallery.ini", "-o", scratch_ / "gallery"})));
    log_ = scratch_ / "gallery/gallery.rawlog";
  }

  omnimapper::testing::ScratchFolder scratch_;
  std::string log_;
};

TEST_F(Comparator, IsSwappedByTheIni) {
  simulate();
  const std::vector<std::size_t> one(3, 1), three(3, 3);
  EXPECT_EQ(countOnWall({}), one);
  EXPECT_EQ(countOnWall({"--set", "planes.comparator=normals"}), one);
  EXPECT_EQ(countOnWall({"--set", "planes.comparator=plane_colour"}), three);
}

TEST_F(Comparator, OfColoursWithoutAPictureLeavesScansOutAndIsAnErrorAlone) {
  simulate("colour = false\n");
  const std::string derived = scratch_ / "derived.rawlog";
  const Texts words{"kinect", "picture", "comparator = plane"};
  Texts by_colour{"--set", "planes.comparator=plane_colour"};
  EXPECT_TRUE(endedWith(ExitCode::damaged_input, perceive(log_, derived, by_colour), words));
  EXPECT_EQ(ofClass<CObservationPlanes>(readLog(derived)).size(), 0U);
  EXPECT_FALSE(readLog(derived).empty()) << "the other extractors process the scans all the same";
  fs::remove(derived);
  by_colour.insert(by_colour.end(), {"--set", "perception.extractors=planes"});
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, perceive(log_, derived, by_colour), words));
  EXPECT_FALSE(fs::exists(derived));
  EXPECT_TRUE(endedWith(ExitCode::wrong_type,
                        perceive(log_, scratch_ / "derived.rawlog", {"--set", "planes.comparator=colour"}),
                        {"plane | plane_colour | normals"}));
}

}  // namespace
