// Tests each comparison of PlaneSegmenter, and one that only this test has.
#include <gtest/gtest.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/perception/PlaneSegmenter.h>

#include <Eigen/Cholesky>
#include <algorithm>

#include "ColouredRooms.h"
#include "PlaneAgreement.h"

namespace omnimapper::perception::plane_comparison_test {
namespace {

constexpr int kWidth = 200, kHeight = 150;  // no multiple of a cell's side
const camera::Pinhole kCamera{200, 200, 99.5, 74.5};
constexpr obs::Rgb kWood{150, 110, 70}, kPaper{235, 235, 230}, kRed{190, 40, 40};

/// A table 1 m away, as seen from above, with two sheets on it: a white and a red one.
struct Table {
  std::vector<float> depth;
  std::vector<obs::Rgb> colours;
  std::vector<int> sheet;  // of each pixel; 0 is the table

  Table() {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        depth.push_back(static_cast<float>(1 / (1 + 0.001 * (x - 99.5) - 0.0005 * (y - 74.5))));
        const bool white = x >= 20 && x < 80 && y >= 30 && y < 110, red = x >= 120 && x < 180 && y >= 60 && y < 120;
        sheet.push_back(white ? 1 : red ? 2 : 0);
        colours.push_back(white ? kPaper : red ? kRed : kWood);
      }
    }
  }
  camera::DepthImage image() const { return {depth.data(), kWidth, kHeight, kCamera}; }
};

PlaneComparisonOptions by(const PlaneComparison& comparison) {
  PlaneComparisonOptions options;
  options.comparison = &comparison;
  return options;
}

PlaneSegmentation segment(const Table& table, const PlaneComparison& comparison) {
  return PlaneSegmenter({}, by(comparison)).segment(table.image(), table.colours);
}

// Share of the pixels that have the most frequent plane label of their sheet.
double shareRight(const Table& table, const PlaneSegmentation& found) {
  double right = 0;
  for (int sheet = 0; sheet < 3; ++sheet) {
    std::vector<int> count(found.planes.size() + 1, 0);
    for (std::size_t i = 0; i < table.sheet.size(); ++i) count[found.labels[i]] += table.sheet[i] == sheet;
    right += *std::max_element(count.begin() + 1, count.end());
  }
  return right / static_cast<double>(table.sheet.size());
}

TEST(PlaneComparison, WithoutColoursATableAndItsSheetsAreOnePlane) {
  const auto found = segment(Table(), kSamePlane);
  ASSERT_EQ(found.planes.size(), 1U);
  EXPECT_EQ(found.planes[0].inliers, kWidth * kHeight);
}

TEST(PlaneComparison, WithColoursEachSheetIsAPlaneToThePixel) {
  const Table table;
  const auto found = segment(table, kSamePlaneAndColour);
  ASSERT_EQ(found.planes.size(), 3U);
  EXPECT_EQ(found.planes[0].inliers, kWidth * kHeight - 60 * 80 - 60 * 60);
  EXPECT_EQ(found.planes[1].inliers, 60 * 80);
  EXPECT_EQ(found.planes[2].inliers, 60 * 60);
  EXPECT_EQ(found.planes[0].holes.size(), 2U);
  EXPECT_EQ(shareRight(table, found), 1);
  for (const auto& plane : found.planes)
    EXPECT_LT((plane.plane_in_sensor.normal - found.planes[0].plane_in_sensor.normal).norm(), 1e-4);
}

// Picture as from a Kinect: colour edges are 4 px wide, it is noisy, and a lamp lights it from one side.
TEST(PlaneComparison, SheetsAreFoundInABlurredNoisyPictureUnderALamp) {
  Table table;
  testing::Dice dice(3);
  const auto sharp = table.colours;
  const auto channel = [&](int x, int y, std::uint8_t obs::Rgb::*member) {
    double sum = 0;
    for (int v = y - 1; v <= y + 2; ++v) {
      for (int u = x - 1; u <= x + 2; ++u) {
        const int column = std::clamp(u, 0, kWidth - 1), row = std::clamp(v, 0, kHeight - 1);
        sum += sharp[static_cast<std::size_t>(row * kWidth + column)].*member / 16.0;
      }
    }
    const double light = 1 - 0.4 * x / kWidth;
    return static_cast<std::uint8_t>(std::clamp(light * sum + dice.normal(4), 0.0, 255.0));
  };
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      table.colours[static_cast<std::size_t>(y * kWidth + x)] = {
          channel(x, y, &obs::Rgb::red), channel(x, y, &obs::Rgb::green), channel(x, y, &obs::Rgb::blue)};
    }
  }
  const auto found = segment(table, kSamePlaneAndColour);
  EXPECT_EQ(found.planes.size(), 3U);
  EXPECT_GT(shareRight(table, found), 0.97);
}

TEST(PlaneComparison, SheetsTooSmallForAPlaneAreHolesInTheTable) {
  PlaneOptions options;
  options.min_pixels = 5000;
  const Table table;
  const auto found = PlaneSegmenter(options, by(kSamePlaneAndColour)).segment(table.image(), table.colours);
  ASSERT_EQ(found.planes.size(), 1U);
  EXPECT_EQ(found.planes[0].holes.size(), 2U);
  for (std::size_t i = 0; i < table.sheet.size(); ++i) ASSERT_EQ(found.labels[i], table.sheet[i] == 0 ? 1 : 0);
}

TEST(PlaneComparison, ColoursThatAreMissingAreAnError) {
  const Table table;
  for (const auto& colours : {std::vector<obs::Rgb>(), std::vector<obs::Rgb>(kWidth * kHeight - 1)}) {
    try {
      PlaneSegmenter({}, by(kSamePlaneAndColour)).segment(table.image(), colours);
      FAIL();
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    }
    EXPECT_EQ(PlaneSegmenter({}).segment(table.image(), colours).planes.size(), 1U) << "comparator = plane needs none";
  }
}

TEST(PlaneComparison, SheetsInNoisyRoomsAreFoundByColourAlone) {
  rooms::Agreement by_plane, by_colour;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    testing::Dice dice(seed);
    const auto room = rooms::colouredRoom(dice);
    const auto view = rooms::render(room.scene);
    const int width = room.scene.width, height = room.scene.height;
    const auto depth = rooms::withNoise(view, width, height, {}, dice);
    const auto colours = rooms::picture(room, view, dice);
    const camera::DepthImage image(depth.data(), width, height, room.scene.camera);
    const auto add = [&](const PlaneComparison& comparison, rooms::Agreement& sum) {
      const auto found = PlaneSegmenter({}, by(comparison)).segment(image, colours);
      sum += rooms::compare(view, found.labels, width, height, 1500);
    };
    add(kSamePlane, by_plane);
    add(kSamePlaneAndColour, by_colour);
  }
  EXPECT_GT(by_colour.found, 0.8 * by_colour.true_planes);
  EXPECT_GT(by_colour.pixelsRight(), 0.9);
  EXPECT_LT(by_plane.found, 0.8 * by_plane.true_planes) << "sheets are one plane with what they lie on";
}

TEST(PlaneComparison, NormalsFindWhatIsFlatAndDropWhatIsMerelySmooth) {
  // First two walls that meet in a corner, then a column 0.6 m thick and nothing else.
  std::vector<float> corner, column;
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const double u = (i % kWidth - 99.5) / 200;
    corner.push_back(static_cast<float>(2 / (1 + std::abs(u))));
    // The ray (u, 1) meets the circle of radius 0.3 around (0, 1).
    const double a = 1 + u * u, root = 1 - a * (1 - 0.09);
    column.push_back(root > 0 ? static_cast<float>((1 - std::sqrt(root)) / a) : 0.F);
  }
  const PlaneSegmenter segmenter({}, by(kSimilarNormals));
  const auto walls = segmenter.segment(camera::DepthImage(corner.data(), kWidth, kHeight, kCamera));
  ASSERT_EQ(walls.planes.size(), 2U);
  for (const auto& wall : walls.planes) {
    EXPECT_NEAR(wall.inliers, kWidth * kHeight / 2, 2 * kHeight);
    EXPECT_NEAR(std::abs(wall.plane_in_sensor.normal.x()), std::sqrt(0.5), 1e-3);
    EXPECT_LT(wall.rms, 1e-3);
  }
  // Strips along its sides are too flat for a Kinect to distinguish them from planes.
  for (const auto& strip : segmenter.segment(camera::DepthImage(column.data(), kWidth, kHeight, kCamera)).planes)
    EXPECT_LT(strip.inliers, 2000);
}

TEST(PlaneComparison, NormalsFindTheLargePlanesOfRooms) {
  rooms::Agreement sum;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    testing::Dice dice(seed);
    const auto scene = rooms::randomRoom(dice);
    const auto view = rooms::render(scene);
    const auto depth = rooms::withNoise(view, scene.width, scene.height, {}, dice);
    const camera::DepthImage image(depth.data(), scene.width, scene.height, scene.camera);
    const auto found = PlaneSegmenter({}, by(kSimilarNormals)).segment(image);
    sum += rooms::compare(view, found.labels, scene.width, scene.height, 1500);
  }
  EXPECT_GT(sum.pixelsRight(), 0.5);
}

// In any image, labels belong to planes, each plane has as many pixels as it reports, and its covariance is positive
// definite.
TEST(PlaneComparison, AnyImageOfAnySizeIsTakenByEach) {
  PlaneOptions options;
  options.min_pixels = 1;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    testing::Dice dice(seed);
    const int width = 1 + static_cast<int>(dice.uniform(0, 70)), height = 1 + static_cast<int>(dice.uniform(0, 70));
    std::vector<float> depth;
    std::vector<obs::Rgb> colours;
    for (int i = 0; i < width * height; ++i) {
      const double z = seed % 3 == 0 ? dice.uniform(-1, 8) : 1 + (i % width > 20) + dice.normal(0.002);
      depth.push_back(dice.uniform(0, 1) < 0.1 ? std::nanf("") : static_cast<float>(z));
      const auto grey = static_cast<std::uint8_t>(seed % 2 == 0 ? dice.uniform(0, 256) : 3 * (i % width));
      colours.push_back({grey, grey, grey});
    }
    const camera::DepthImage image(depth.data(), width, height, {60, 60, 0.5 * width, 0.5 * height});
    for (const PlaneComparison* comparison : {&kSamePlane, &kSamePlaneAndColour, &kSimilarNormals}) {
      const auto found = PlaneSegmenter(options, by(*comparison)).segment(image, colours);
      std::vector<int> pixels(found.planes.size() + 1, 0);
      for (const auto label : found.labels) ++pixels.at(label);
      for (std::size_t i = 0; i < found.planes.size(); ++i) {
        EXPECT_EQ(found.planes[i].inliers, pixels[i + 1]) << "seed " << seed;
        EXPECT_EQ(found.planes[i].covariance.llt().info(), Eigen::Success) << "seed " << seed;
      }
    }
  }
}

/// A comparator that only this test has: it cuts planes in two in the middle of the image.
struct LeftAndRight {
  PlanePixels pixels;
  bool valid(int pixel) const { return pixels.planes[pixel] != 0; }
  bool similar(int a, int b) const { return pixels.planes[a] == pixels.planes[b] && isLeft(a) == isLeft(b); }
  bool isLeft(int pixel) const { return pixel % pixels.width < kWidth / 2; }
};

const PlaneComparison kLeftAndRight{kSamePlane.find, [](const PlanePixels& pixels, const PlaneComparisonOptions&) {
                                      return connectPieces(pixels, LeftAndRight{pixels});
                                    }};

TEST(PlaneComparison, AComparatorIsAFewLines) {
  const Table table;
  const auto found = segment(table, kLeftAndRight);
  ASSERT_EQ(found.planes.size(), 2U);
  for (const auto& plane : found.planes) EXPECT_EQ(plane.inliers, kWidth / 2 * kHeight);
  EXPECT_NE(found.labels[kWidth / 2 - 1], found.labels[kWidth / 2]);
}

/// Cuts a plane in the middle of each row but one, so that both sides of the cut are still one component.
struct CutButInOneRow {
  PlanePixels pixels;
  bool valid(int pixel) const { return pixels.planes[pixel] != 0; }
  bool similar(int, int b) const { return b % pixels.width != kWidth / 2 || b / pixels.width == kHeight / 2; }
};

const PlaneComparison kCutButInOneRow{kSamePlane.find, [](const PlanePixels& pixels, const PlaneComparisonOptions&) {
                                        return connectComponents(pixels.width, pixels.height, CutButInOneRow{pixels});
                                      }};

TEST(PlaneComparison, RunsOfOneComponentMayLieSideBySide) {
  const auto found = segment(Table(), kCutButInOneRow);
  ASSERT_EQ(found.planes.size(), 1U);
  EXPECT_EQ(found.planes[0].inliers, kWidth * kHeight);
  EXPECT_EQ(found.planes[0].outline.corners.size(), 4U);
  EXPECT_TRUE(found.planes[0].holes.empty());
}

}  // namespace
}  // namespace omnimapper::perception::plane_comparison_test
