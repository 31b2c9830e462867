// ArUco markers that omnimapper-perceive finds in images are counted in the summary and drawn in the pictures.
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/obs/IndexColour.h>
#include <omnimapper/source/RawlogWriter.h>
#include <omnimapper/testing/MarkerPicture.h>

#include "PerceiveRuns.h"

namespace {

using namespace perceived;

omnimapper::testing::MarkerCorners squareAround(double x, double y) {
  constexpr double kHalf = 40;  // [px]
  return {{{x - kHalf, y - kHalf}, {x + kHalf, y - kHalf}, {x + kHalf, y + kHalf}, {x - kHalf, y + kHalf}}};
}

/// Writes a log with a picture of markers 5 and 23, and one of an empty wall.
void writeLog(const std::string& path) {
  omnimapper::source::writeRawlog(path, [](omnimapper::source::RawlogWriter& rawlog) {
    for (const bool is_empty : {false, true}) {
      omnimapper::testing::MarkerPicture drawn(640, 480);
      if (!is_empty) {
        drawn.draw(5, squareAround(200, 300));
        drawn.draw(23, squareAround(450, 200));
      }
      mrpt::obs::CObservationImage picture;
      picture.timestamp = omnimapper::base::stampFromUnix(is_empty ? 101 : 100);
      picture.sensorLabel = "camera";
      picture.cameraParams.ncols = 640;
      picture.cameraParams.nrows = 480;
      picture.cameraParams.setIntrinsicParamsFromValues(500, 500, 319.5, 239.5);
      picture.image = drawn.colour();
      rawlog.add(picture);
    }
  });
}

bool isMarked(const mrpt::img::CImage& image, unsigned x, unsigned y, std::size_t number) {
  const auto* pixel = image.ptrLine<std::uint8_t>(y) + 3 * x;
  const auto colour = omnimapper::obs::indexColour(number);
  return pixel[2] == colour.R && pixel[1] == colour.G && pixel[0] == colour.B;
}

TEST(Markers, AreCountedAndDrawn) {
  const omnimapper::testing::ScratchFolder scratch;
  writeLog(scratch / "raw.rawlog");
  writeFile(scratch / "markers.ini", "[perception]\nextractors = markers\n[markers]\nclass = ArucoMarkerExtractor\n");
  const auto ended = runProgram({omnimapper::testing::ownProgram("omnimapper-perceive"), "-i", scratch / "markers.ini",
                                 "-r", scratch / "raw.rawlog", "-o", scratch / "found.rawlog", "--pictures",
                                 scratch / "pictures", "--picture-every", "1"});
  ASSERT_TRUE(endedWith(ExitCode::ok, ended));
  EXPECT_NE(ended.out.find("camera.markers: 2 markers in 2 observations"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("2 pictures in "), std::string::npos) << ended.out;
  mrpt::img::CImage marked, empty;
  ASSERT_TRUE(marked.loadFromFile(scratch / "pictures/camera_100.000000.png"));
  ASSERT_TRUE(empty.loadFromFile(scratch / "pictures/camera_101.000000.png"));
  EXPECT_TRUE(isMarked(marked, 200, 300, 5));
  EXPECT_TRUE(isMarked(marked, 450, 200, 23));
  EXPECT_FALSE(isMarked(empty, 200, 300, 5));
}

}  // namespace
