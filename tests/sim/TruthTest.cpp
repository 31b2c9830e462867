// Ideal measurements lie on the true surfaces, and labels name the surfaces on which they lie.
#include <gtest/gtest.h>
#include <mrpt/img/CImage.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/sim/Simulation.h>
#include <omnimapper/testing/Fixtures.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

namespace truth_test {
namespace {

using namespace omnimapper;
using geometry::Plane3;
using geometry::Se3;

class Truth : public ::testing::TestWithParam<std::tuple<const char*, int>> {
 protected:
  Truth() : simulation_(configOf(std::get<0>(GetParam()), std::get<1>(GetParam()))) {}

  static base::Config configOf(const std::string& generator, int seed) {
    const std::string number = std::to_string(seed);
    return base::Config::fromText("[simulation]\nsensors = laser, camera\nduration_s = 100\nseed = " + number +
                                      "\n[world]\ngenerator = " + generator + "\nseed = " + number +
                                      "\n[robot]\nmode = tour\n"
                                      "[laser]\nclass = Laser2d\nmodel = ideal\nz_m = 0.35\ntruth_ranges = true\n"
                                      "[camera]\nclass = RgbdCamera\nmodel = ideal\nlabels = true\nz_m = 1.1\n"
                                      "width_px = 320\nheight_px = 240\n",
                                  "truth.ini");
  }

  const sim::Sensor& sensor(const std::string& label) const {
    for (const auto& sensor : simulation_.sensors()) {
      if (sensor->label() == label) return *sensor;
    }
    throw std::runtime_error("no sensor " + label);
  }

  /// The plane of the flat surface with a label, at a time.
  std::optional<Plane3> planeInMap(int label, double time) const {
    if (label == 0) return std::nullopt;
    const auto ref = sim::numberSurfaces(simulation_.world()).at(static_cast<std::size_t>(label) - 1);
    const sim::Body& body = simulation_.world().bodies[static_cast<std::size_t>(ref.body)];
    const auto& face = body.surfaces[static_cast<std::size_t>(ref.surface)].face;
    const auto map_from_body = body.track.at(time);
    if (!face || !map_from_body) return std::nullopt;
    return *map_from_body * face->plane_in_body;
  }

  /// The label image of a measurement, read from its file.
  mrpt::img::CImage labelsOf(const sim::Measurement& measurement) {
    const std::string path = scratch_ / "labels.png";
    std::ofstream(path, std::ios::binary) << measurement.truth_files.at(0).bytes;
    mrpt::img::CImage labels;
    EXPECT_TRUE(labels.loadFromFile(path, -1));
    return labels;
  }

  const sim::Simulation simulation_;
  omnimapper::testing::ScratchFolder scratch_;
};

TEST_P(Truth, idealDepthLiesOnThePlanesThatTheLabelImageNames) {
  const sim::Sensor& camera = sensor("camera");
  std::size_t on_planes = 0, off_planes = 0, pixels = 0;
  std::map<int, double> worst;  // of labels that some pixel is off
  for (int k = 0; k < camera.count(); k += std::max(1, camera.count() / 5)) {
    const auto measurement = camera.measure(k);
    const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*measurement.observation);
    const auto labels = labelsOf(measurement);
    ASSERT_EQ(labels.getWidth(), 320U);
    const double time = camera.timeOf(k);
    const Se3 map_from_sensor = *simulation_.mapFromBase().at(time) * geometry::fromMrpt(scan.sensorPose);
    std::map<int, std::optional<Plane3>> planes;
    for (int row = 0; row < 240; row += 3) {
      for (int column = 0; column < 320; column += 3) {
        const double depth = scan.rangeImage(row, column) * scan.rangeUnits;
        const int label = labels.ptrLine<std::uint16_t>(static_cast<unsigned>(row))[column];
        ++pixels;
        if (depth == 0) continue;
        const auto plane = planes.try_emplace(label, planeInMap(label, time)).first->second;
        if (!plane) continue;
        // MRPT's axes of a range camera: x forward, y to the left, z up.
        const auto& c = scan.cameraParams;
        const Eigen::Vector3d in_sensor(depth, -(column - c.cx()) / c.fx() * depth, -(row - c.cy()) / c.fy() * depth);
        // Depth is a whole number of rangeUnits.
        const double away = std::abs(geometry::signedDistance(*plane, map_from_sensor * in_sensor));
        ++(away < 1e-3 ? on_planes : off_planes);
        if (away >= 1e-3) worst[label] = std::max(worst[label], away);
      }
    }
  }
  for (const auto& [label, away] : worst) ADD_FAILURE() << "label " << label << ": " << away << " m off its plane";
  EXPECT_GT(on_planes, 0.6 * static_cast<double>(pixels));
}

TEST_P(Truth, objectsAreCountedAsTheLabelImageShowsThem) {
  const sim::Sensor& camera = sensor("camera");
  const sim::World& world = simulation_.world();
  const auto refs = sim::numberSurfaces(world);
  int images_with_objects = 0;
  for (int k = 0; k < camera.count(); k += std::max(1, camera.count() / 10)) {
    const auto measurement = camera.measure(k);
    const auto& scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan&>(*measurement.observation);
    const auto labels = labelsOf(measurement);
    std::map<std::string, int> pixels, with_depth;
    std::map<std::string, std::pair<int, int>> columns;
    for (int row = 0; row < 240; ++row) {
      for (int column = 0; column < 320; ++column) {
        const int label = labels.ptrLine<std::uint16_t>(static_cast<unsigned>(row))[column];
        if (label == 0) continue;
        const std::string& body =
            world.bodies[static_cast<std::size_t>(refs[static_cast<std::size_t>(label - 1)].body)].name;
        ++pixels[body];
        with_depth[body] += scan.rangeImage(row, column) > 0 ? 1 : 0;
        auto& range = columns.try_emplace(body, column, column).first->second;
        range = {std::min(range.first, column), std::max(range.second, column)};
      }
    }
    std::size_t expected = 0;
    for (const auto& object : world.objects) expected += pixels.count(object.name);
    EXPECT_EQ(measurement.objects.size(), expected) << k;
    for (const auto& view : measurement.objects) {
      const std::string& name = world.objects[static_cast<std::size_t>(view.object)].name;
      EXPECT_EQ(view.pixels, pixels[name]) << name;
      EXPECT_EQ(view.with_depth, with_depth[name]) << name;
      EXPECT_EQ(std::make_pair(view.left, view.right), columns[name]) << name;
      EXPECT_GT(view.distance, 0.1) << name;
    }
    images_with_objects += expected > 0 ? 1 : 0;
  }
  // Few of the images of an office's or a laboratory's halls show objects, perhaps none of these ten.
  if (std::string(std::get<0>(GetParam())) == "home") {
    EXPECT_GT(images_with_objects, 0);
  }
}

TEST_P(Truth, idealBeamsEndOnTheSurfacesThatTheTruthNames) {
  const sim::Sensor& laser = sensor("laser");
  std::size_t on_planes = 0, beams = 0;
  for (int k = 0; k < laser.count(); k += std::max(1, laser.count() / 20)) {
    const auto measurement = laser.measure(k);
    const auto& scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(*measurement.observation);
    const auto truth = nlohmann::json::parse(measurement.truth);
    std::vector<int> labels;
    for (const auto& [label, count] : truth["surfaces"].get<std::vector<std::pair<int, int>>>())
      labels.insert(labels.end(), static_cast<std::size_t>(count), label);
    ASSERT_EQ(labels.size(), scan.getScanSize());
    const double time = laser.timeOf(k);
    const Se3 map_from_sensor = *simulation_.mapFromBase().at(time) * geometry::fromMrpt(scan.sensorPose);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      ++beams;
      const auto plane = planeInMap(labels[i], time);
      if (!scan.getScanRangeValidity(i) || !plane) continue;
      const double angle = scan.getScanAngle(i), range = scan.getScanRange(i);
      const Eigen::Vector3d in_sensor(range * std::cos(angle), range * std::sin(angle), 0);
      EXPECT_LT(std::abs(geometry::signedDistance(*plane, map_from_sensor * in_sensor)), 1e-3) << k << " " << i;
      ++on_planes;
    }
  }
  EXPECT_GT(on_planes, 0.5 * static_cast<double>(beams));
}

INSTANTIATE_TEST_SUITE_P(PlacesAndSeeds, Truth,
                         ::testing::Combine(::testing::Values("home", "office", "laboratory", "two_offices"),
                                            ::testing::Values(1, 2)),
                         [](const auto& info) {
                           return std::string(std::get<0>(info.param)) + "_" + std::to_string(std::get<1>(info.param));
                         });

}  // namespace
}  // namespace truth_test
