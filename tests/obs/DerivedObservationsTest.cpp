#include <gtest/gtest.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/opengl/CArrow.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/opengl/CSetOfTriangles.h>
#include <mrpt/opengl/CText.h>
#include <mrpt/opengl/CTexturedPlane.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <cstring>
#include <sstream>

#include "FilledObjects.h"

namespace omnimapper::obs::derived_observations_test {
namespace {

// Reads a row by its header: groups of fields between { and }, each as often as the field before it says.
class RowReader {
 public:
  RowReader(const std::string& header, const std::string& row) : header_(header), row_(row) {
    std::istringstream names(header);
    for (std::string name; names >> name;) names_.push_back(name);
    std::size_t at = 0;
    readFields(at, names_.size(), "");
  }
  /// A field by its path, such as "planes/0/outline/2/x_m".
  std::string operator[](const std::string& path) const { return fields_.count(path) ? fields_.at(path) : "absent"; }
  double number(const std::string& path) const { return std::stod(fields_.at(path)); }
  bool isWhole() {
    std::string more;
    return !(row_ >> more) && !row_.bad();
  }

 private:
  std::size_t closing(std::size_t open) const {
    int depth = 0;
    for (std::size_t i = open; i < names_.size(); ++i) {
      depth += names_[i] == "{" ? 1 : names_[i] == "}" ? -1 : 0;
      if (depth == 0) return i;
    }
    return names_.size();
  }
  void readFields(std::size_t begin, std::size_t end, const std::string& path) {
    for (std::size_t i = begin; i < end; ++i) {
      std::string value;
      ASSERT_TRUE(row_ >> value) << "no field for " << path << names_[i];
      fields_[path + names_[i]] = value;
      if (i + 1 >= end || names_[i + 1] != "{") continue;
      const std::size_t close = closing(i + 1);
      for (int k = 0; k < std::stoi(value); ++k)
        readFields(i + 2, close, path + names_[i] + "/" + std::to_string(k) + "/");
      i = close;
    }
  }

  std::string header_;
  std::istringstream row_;
  std::vector<std::string> names_;
  std::map<std::string, std::string> fields_;
};

template <class Observation>
RowReader rowOf(const Observation& observation) {
  return RowReader(observation.exportTxtHeader(), observation.exportTxtDataRow());
}

void expectMentions(const std::string& text, const std::vector<std::string>& words) {
  for (const auto& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " is not in\n" << text;
}

TEST(DerivedObservations, areBornWithoutStampAndTheirSensorPoseCanBeSet) {
  CObservationPlanes planes;
  EXPECT_FALSE(base::isValid(planes.timestamp));
  const mrpt::poses::CPose3D pose(1, 2, 3, 0.1, 0.2, 0.3);
  static_cast<mrpt::obs::CObservation&>(planes).setSensorPose(pose);
  mrpt::poses::CPose3D read;
  planes.getSensorPose(read);
  EXPECT_EQ(read, pose);
}

TEST(DerivedObservations, everyRowHasTheFieldsThatItsHeaderSays) {
  for (const auto& [name, make] : filledObjects()) {
    const auto object = make();
    const auto& observation = dynamic_cast<const mrpt::obs::CObservation&>(*object);
    ASSERT_TRUE(observation.exportTxtSupported()) << name;
    EXPECT_EQ(observation.exportTxtDataRow().find('\n'), std::string::npos) << name;
    EXPECT_TRUE(RowReader(observation.exportTxtHeader(), observation.exportTxtDataRow()).isWhole()) << name;
  }
  EXPECT_EQ(CObservationPlanes().exportTxtDataRow(), "0");
}

TEST(CObservationPlanes, exportsEachPlaneInFull) {
  const auto planes = filledPlanes();
  const auto row = rowOf(*planes);
  EXPECT_EQ(row["planes"], "2");
  EXPECT_EQ(row.number("planes/0/nz"), 1);
  EXPECT_EQ(row.number("planes/1/distance_m"), 4);
  EXPECT_EQ(row.number("planes/0/cov_2_d"), planes->planes[0].covariance(1, 2));
  EXPECT_EQ(row.number("planes/0/area_m2"), 8);  // 3 x 3 without its hole of 1 x 1
  EXPECT_EQ(row["planes/0/inliers"], "120000");
  EXPECT_EQ(row["planes/0/green"], "110");
  EXPECT_EQ(row["planes/1/green"], "-1");
  EXPECT_EQ(row["planes/1/outline"], "6");
  EXPECT_EQ(row.number("planes/1/outline/3/y_m"), 0.3);
  EXPECT_EQ(row["planes/0/holes/0/vertices"], "4");
  EXPECT_EQ(row.number("planes/0/holes/0/vertices/2/x_m"), 3);
}

TEST(CObservationPlanes, describesWhatAPersonWantsToKnow) {
  expectMentions(filledPlanes()->asString(), {"camera.planes", "labelled: camera", "2 planes", "normal 0 0 1",
                                              "distance 0.9 m", "area 8 m^2", "1 holes", "colour 120 110 90"});
}

// Area of all triangles of a scene's first set.
double drawnArea(const mrpt::opengl::CSetOfObjects& scene, std::size_t index) {
  const auto triangles = scene.getByClass<mrpt::opengl::CSetOfTriangles>(index);
  if (!triangles) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < triangles->getTrianglesCount(); ++i) {
    mrpt::opengl::TTriangle t;
    triangles->getTriangle(i, t);
    const auto point = [&](std::size_t k) {
      return Eigen::Vector3d(t.vertices[k].xyzrgba.pt.x, t.vertices[k].xyzrgba.pt.y, t.vertices[k].xyzrgba.pt.z);
    };
    sum += 0.5 * (point(1) - point(0)).cross(point(2) - point(0)).norm();
  }
  return sum;
}

TEST(CObservationPlanes, fillsConcaveOutlinesAndLeavesHolesOpen) {
  const auto scene = filledPlanes()->getVisualization();
  const auto in_sensor = scene->getByClass<mrpt::opengl::CSetOfObjects>();
  ASSERT_TRUE(in_sensor);
  EXPECT_EQ(in_sensor->getPoseX(), 0.1);
  EXPECT_NEAR(drawnArea(*in_sensor, 0), 8, 1e-5);
  EXPECT_NEAR(drawnArea(*in_sensor, 1), 3 * 2.2 - 1.2 * 1.1, 1e-5);
  EXPECT_TRUE(in_sensor->getByClass<mrpt::opengl::CArrow>());
}

TEST(CObservationPlanes, fillsAnOutlineOfManyVerticesNearlyAsLarge) {
  auto planes = *filledPlanes();
  auto& plane = planes.planes[0];
  plane.holes.clear();
  plane.outline.vertices.clear();
  for (int i = 0; i < 3000; ++i) {
    const double turn = 2 * 3.14159265358979 * i / 3000, radius = 1 + 0.2 * std::sin(7 * turn);
    plane.outline.vertices.push_back({radius * std::cos(turn), radius * std::sin(turn), -0.9});
  }
  planes.planes.resize(1);
  EXPECT_NEAR(drawnArea(*planes.getVisualization()->getByClass<mrpt::opengl::CSetOfObjects>(), 0), area(plane.outline),
              0.01 * area(plane.outline));
}

TEST(CObservationPlanes, whatIsNotANumberIsNotDrawn) {
  auto planes = *filledPlanes();
  const double nan = std::nan("");
  planes.planes[0].outline.vertices[1].setConstant(nan);
  planes.planes[1].plane_in_sensor.normal.setConstant(nan);
  EXPECT_TRUE(planes.getVisualization());
}

TEST(CObservationPlanes, whatIsTooFarToAddUpIsNotDrawn) {
  auto planes = *filledPlanes();
  planes.planes.resize(1);
  auto& vertices = planes.planes[0].outline.vertices;
  vertices.clear();
  for (int i = 0; i < 200; ++i) vertices.push_back({i % 3 == 0 ? 1e308 : -1e308, i % 2 == 0 ? 1e308 : -1e308, -0.9});
  planes.planes[0].holes.clear();
  EXPECT_EQ(drawnArea(*planes.getVisualization()->getByClass<mrpt::opengl::CSetOfObjects>(), 0), 0);
}

TEST(CObservationLaserLines, exportsEachLineInFull) {
  const auto lines = filledLines();
  const auto row = rowOf(*lines);
  EXPECT_EQ(row["lines"], "2");
  EXPECT_EQ(row.number("lines/0/from_y_m"), -2);
  EXPECT_EQ(row.number("lines/1/distance_m"), 1);
  EXPECT_EQ(row.number("lines/0/cov_angle_distance"), lines->lines[0].covariance(0, 1));
  EXPECT_EQ(row["lines/0/from_end"], "occluded");
  EXPECT_EQ(row["lines/1/to_end"], "view");
  EXPECT_EQ(row["lines/1/last_beam"], "180");
}

TEST(CObservationLaserLines, describesWhatAPersonWantsToKnow) {
  expectMentions(filledLines()->asString(),
                 {"2 lines", "from (3, -2) m [occluded] to (3, 1) m [wall]", "length 3 m", "beams 40 to 110", "11 mm"});
}

TEST(CObservationLaserLines, drawsAStrokeForEachLineAndABarAcrossAWallsOwnEnd) {
  const auto scene = filledLines()->getVisualization()->getByClass<mrpt::opengl::CSetOfObjects>();
  ASSERT_TRUE(scene);
  const auto strokes = scene->getByClass<mrpt::opengl::CSetOfTriangles>(0);
  ASSERT_TRUE(strokes);
  EXPECT_EQ(strokes->getTrianglesCount(), 8U);  // the line and the bar at its one end
  EXPECT_TRUE(scene->getByClass<mrpt::opengl::CSetOfTriangles>(1));
}

TEST(CObservationObjects, exportsEachObjectInFull) {
  const auto row = rowOf(*filledDetections());
  EXPECT_EQ(row["objects"], "2");
  EXPECT_EQ(row["objects/0/class_label"], "coffee%20mug");
  EXPECT_EQ(row["objects/1/class_label"], "-");
  EXPECT_EQ(row["objects/0/supporting_plane"], "1");
  EXPECT_EQ(row["objects/1/supporting_plane"], "-1");
  EXPECT_NEAR(row.number("objects/0/box_qw"), std::cos(0.3), 1e-15);
  EXPECT_EQ(row["objects/0/points"], "60");
  EXPECT_EQ(row["objects/0/points/59/red"], "209");
  EXPECT_EQ(row["objects/1/points/39/red"], "-1");
}

TEST(CObservationObjects, describesWhatAPersonWantsToKnow) {
  expectMentions(filledDetections()->asString(),
                 {"2 objects", "box of 0.3 x 0.2 x 0.25 m", "60 points in colour, on plane 1", "\"coffee mug\""});
}

TEST(CObservationObjects, drawsBoxPointsAndLabel) {
  const auto scene = filledDetections()->getVisualization()->getByClass<mrpt::opengl::CSetOfObjects>();
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->getByClass<mrpt::opengl::CSetOfLines>()->getLineCount(), 12U);
  EXPECT_EQ(scene->getByClass<mrpt::opengl::CPointCloudColoured>(1)->size(), 40U);
  EXPECT_EQ(scene->getByClass<mrpt::opengl::CText>()->getString(), "coffee mug");
  EXPECT_EQ(scene->getByClass<mrpt::opengl::CText>(1)->getString(), "object 1");
}

TEST(CObservationDoorSigns, exportsEachSignInFull) {
  const auto row = rowOf(*filledSigns());
  EXPECT_EQ(row["signs"], "2");
  EXPECT_EQ(row.number("signs/0/corner_2_y_px"), 226.25);
  EXPECT_EQ(row.number("signs/0/range_m"), 1.5);
  EXPECT_EQ(row["signs/1/range_m"], "nan");
  EXPECT_EQ(row["signs/0/patch_width_px"], "24");
  EXPECT_EQ(row["signs/0/texts/0/text"], "Room%20241");
  EXPECT_EQ(row.number("signs/0/texts/1/confidence"), 0.55);
}

TEST(CObservationDoorSigns, describesWhatAPersonWantsToKnow) {
  expectMentions(filledSigns()->asString(), {"2 door signs", "range 1.5 +- 0.05 m", "(340.5, 201)",
                                             "patch of 24 x 16 px", "\"Room 241\"", "\"B\\u00fcro\""});
}

TEST(CObservationDoorSigns, drawsPatchAndTextAtTheRangeAlongTheRay) {
  const auto signs = filledSigns();
  const auto scene = signs->getVisualization()->getByClass<mrpt::opengl::CSetOfObjects>();
  ASSERT_TRUE(scene);
  const auto picture = scene->getByClass<mrpt::opengl::CTexturedPlane>();
  ASSERT_TRUE(picture);
  const Eigen::Vector3d middle = 1.5 * signs->signs[0].ray;
  EXPECT_LT((middle - Eigen::Vector3d(picture->getPoseX(), picture->getPoseY(), picture->getPoseZ())).norm(), 1e-12);
  EXPECT_EQ(scene->getByClass<mrpt::opengl::CText>()->getString(), "Room 241 / B\\u00fcro");
}

TEST(CObservationDoorSigns, whatIsNoUtf8IsShownAsBytes) {
  auto signs = *filledSigns();
  signs.signs[0].texts = {{"a\xFC\xE2\x82\xAC\xF0\x9F\x9A\xAA\xC3", 1}};
  expectMentions(signs.asString(), {"\"a\\xfc\\u20ac\\U0001f6aa\\xc3\""});
}

TEST(CObservationDoorSigns, keepEveryPixelOfTheirPatches) {
  const auto signs = filledSigns();
  mrpt::io::CMemoryStream stream;
  auto archive = mrpt::serialization::archiveFrom(stream);
  archive << *signs;
  stream.Seek(0);
  const auto copy = std::dynamic_pointer_cast<CObservationDoorSigns>(archive.ReadObject());
  ASSERT_TRUE(copy);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto &was = signs->signs[i].patch, &is = copy->signs[i].patch;
    ASSERT_EQ(is.getWidth(), was.getWidth());
    ASSERT_EQ(is.isColor(), was.isColor());
    for (unsigned y = 0; y < was.getHeight(); ++y) {
      const std::size_t length = was.getWidth() * (was.isColor() ? 3 : 1);
      EXPECT_EQ(std::memcmp(is.ptrLine<std::uint8_t>(y), was.ptrLine<std::uint8_t>(y), length), 0);
    }
  }
}

}  // namespace
}  // namespace omnimapper::obs::derived_observations_test
