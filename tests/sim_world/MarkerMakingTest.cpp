#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/MarkerMaking.h>
#include <omnimapper/sim_world/Scene.h>

#include <opencv2/aruco.hpp>

namespace marker_making_test {
namespace {

using namespace omnimapper;
using Eigen::Vector3d;
using sim::MarkerDictionary;

// A picture by parallel rays from the front of the marker, one pixel a millimetre; its x is to the right, its y up.
cv::Mat lookAt(const sim::MadeMarker& made, int side) {
  sim::World world;
  world.bodies.push_back(made.body);
  world.markers.push_back(made.marker);
  sim::validate(world);
  const sim::Scenes scenes(world);
  const sim::Scene scene = scenes.at(0);
  const geometry::Se3 map_from_marker = *made.body.track.at(0);
  cv::Mat image(side, side, CV_8U, cv::Scalar(128));
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const Vector3d eye((column + 0.5 - side / 2.0) * 1e-3, (side / 2.0 - row - 0.5) * 1e-3, 1);
      const sim::Hit hit = scene.cast({map_from_marker * eye, map_from_marker.rotation * -Vector3d::UnitZ()});
      if (!hit.isHit()) continue;
      const auto colour = scenes.material(hit.surface).texture->at(hit.texture_at.x(), hit.texture_at.y());
      image.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(255 * colour.x());
    }
  }
  return image;
}

TEST(MarkerMaking, opencvFindsIdAndCornersInAnUprightView) {
  for (const auto& [dictionary, code, id] : {std::tuple(MarkerDictionary::dict_4x4_50, cv::aruco::DICT_4X4_50, 17),
                                             {MarkerDictionary::dict_4x4_50, cv::aruco::DICT_4X4_50, 49},
                                             {MarkerDictionary::dict_6x6_250, cv::aruco::DICT_6X6_250, 203}}) {
    sim::MarkerSpec spec;
    spec.name = "marker";
    spec.dictionary = dictionary;
    spec.id = id;
    spec.side = 0.2;
    spec.map_from_marker = {Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Vector3d(1, 2, 3).normalized())), {1, -2, 3}};
    std::vector<std::vector<cv::Point2f>> corners;
    std::vector<int> ids;
    cv::aruco::detectMarkers(lookAt(sim::makeMarker(spec), 400), cv::aruco::getPredefinedDictionary(code), corners,
                             ids);
    ASSERT_EQ(ids, std::vector<int>{id});
    // The first corner is the marker's upper left, then clockwise; the square is 200 pixels around the middle.
    EXPECT_NEAR(corners[0][0].x, 100, 1.5);
    EXPECT_NEAR(corners[0][0].y, 100, 1.5);
    EXPECT_NEAR(corners[0][1].x, 300, 1.5);
    EXPECT_NEAR(corners[0][2].y, 300, 1.5);
  }
}

TEST(MarkerMaking, refusesWhatIsNotThere) {
  sim::MarkerSpec spec;
  spec.name = "marker";
  spec.id = 50;
  EXPECT_THROW(sim::makeMarker(spec), base::Error);
  spec.id = -1;
  EXPECT_THROW(sim::makeMarker(spec), base::Error);
  spec.id = 0;
  spec.side = 0;
  EXPECT_THROW(sim::makeMarker(spec), base::Error);
  EXPECT_THROW(sim::markerDictionaryOf("5x5_100"), base::Error);
  EXPECT_EQ(sim::markerDictionaryOf("6x6_250"), MarkerDictionary::dict_6x6_250);
}

}  // namespace
}  // namespace marker_making_test
