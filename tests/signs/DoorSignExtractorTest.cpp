#include <gtest/gtest.h>
#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/net/Network.h>
#include <omnimapper/signs/DoorSignExtractor.h>
#include <omnimapper/testing/Fixtures.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>

namespace omnimapper::signs {
namespace {

void write(cv::Mat& picture, const std::string& text, cv::Point at, double size) {
  cv::putText(picture, text, at, cv::FONT_HERSHEY_SIMPLEX, size, cv::Scalar(235, 235, 235), 3, cv::LINE_AA);
}

// A plate of 180 x 130 px at (230, 150).
mrpt::obs::CObservationImage::Ptr view() {
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(150, 170, 180));
  picture(cv::Rect(230, 150, 180, 130)) = cv::Scalar(90, 60, 60);
  write(picture, "26-138", {250, 205}, 1.2);
  write(picture, "OFFICE", {252, 255}, 0.9);
  cv::GaussianBlur(picture, picture, {}, 0.8);
  auto observation = mrpt::obs::CObservationImage::Create();
  observation->sensorLabel = "camera";
  observation->timestamp = mrpt::Clock::fromDouble(1e9);
  observation->cameraParams.ncols = 640;
  observation->cameraParams.nrows = 480;
  observation->cameraParams.setIntrinsicParamsFromValues(500, 500, 320, 240);
  observation->cameraPose = mrpt::poses::CPose3D(0.1, 0, 1.2, 0, 0, 0);
  observation->image = mrpt::img::CImage(picture, mrpt::img::DEEP_COPY);
  return observation;
}

class DoorSignExtractorTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(net::modelsFolder() + "/text_detector.onnx"))
      GTEST_SKIP() << "the networks are missing: scripts/models fetches them";
  }
};

TEST_F(DoorSignExtractorTest, readsAPlateAndLocatesIt) {
  const auto found = DoorSignExtractor({}).signsIn(*view());
  EXPECT_EQ(found->sensorLabel, "camera.signs");
  EXPECT_EQ(found->source_label, "camera");
  EXPECT_EQ(found->sensorPose, view()->cameraPose);
  ASSERT_EQ(found->signs.size(), 1u);
  const auto& sign = found->signs[0];
  ASSERT_EQ(sign.texts.size(), 2u);
  EXPECT_EQ(sign.texts[0].text, "26-138");
  EXPECT_EQ(sign.texts[1].text, "OFFICE");
  EXPECT_GT(sign.texts[0].confidence, 0.9);
  EXPECT_LT((sign.corners_px[0] - Eigen::Vector2f(230, 150)).norm(), 4);
  EXPECT_LT((sign.corners_px[2] - Eigen::Vector2f(409, 279)).norm(), 4);
  const Eigen::Vector3d ray = Eigen::Vector3d(-0.5 / 500, -25.5 / 500, 1).normalized();
  EXPECT_LT((sign.ray - ray).norm(), 0.008);
  EXPECT_FALSE(sign.range.has_value());
  EXPECT_NEAR(static_cast<double>(sign.patch.getWidth()), 180, 5);
}

TEST_F(DoorSignExtractorTest, halfASignIsNotSure) {
  const auto whole = view();
  for (const int columns : {300, 320, 340}) {
    auto half = view();
    half->image = mrpt::img::CImage(
        cv::Mat(whole->image.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY), cv::Rect(0, 0, columns, 480)).clone(),
        mrpt::img::DEEP_COPY);
    half->cameraParams.ncols = static_cast<std::uint32_t>(columns);
    const auto found = DoorSignExtractor({}).signsIn(*half);
    for (const auto& sign : found->signs)
      for (const auto& text : sign.texts) EXPECT_LT(text.confidence, 0.9) << columns << " " << text.text;
  }
}

TEST_F(DoorSignExtractorTest, theSameImageGivesTheSameBits) {
  const DoorSignExtractor extractor({});
  const auto first = extractor.signsIn(*view()), second = extractor.signsIn(*view());
  ASSERT_EQ(first->signs.size(), second->signs.size());
  for (std::size_t i = 0; i < first->signs.size(); ++i) {
    EXPECT_EQ(first->signs[i].corners_px, second->signs[i].corners_px);
    EXPECT_EQ(first->signs[i].texts[0].confidence, second->signs[i].texts[0].confidence);
  }
}

TEST_F(DoorSignExtractorTest, imagesWithoutSignsShowNone) {
  const DoorSignExtractor extractor({});
  auto image = view();
  image->image = mrpt::img::CImage();
  EXPECT_TRUE(extractor.signsIn(*image)->signs.empty());
  for (const auto size : {cv::Size(640, 480), cv::Size(1, 1), cv::Size(3, 900)}) {
    image->image = mrpt::img::CImage(cv::Mat(size, CV_8UC1, cv::Scalar(99)), mrpt::img::DEEP_COPY);
    image->cameraParams.ncols = static_cast<std::uint32_t>(size.width);
    image->cameraParams.nrows = static_cast<std::uint32_t>(size.height);
    EXPECT_TRUE(extractor.signsIn(*image)->signs.empty()) << size;
  }
  mrpt::obs::CObservation3DRangeScan scan;
  EXPECT_TRUE(extractor.signsIn(scan)->signs.empty()) << "it has no image";
}

TEST_F(DoorSignExtractorTest, aCameraWithoutCalibrationIsAnError) {
  auto image = view();
  image->cameraParams.setIntrinsicParamsFromValues(0, 0, 0, 0);
  EXPECT_THROW(DoorSignExtractor({}).signsIn(*image), base::Error);
}

TEST_F(DoorSignExtractorTest, theCalibrationOfALargerImageIsScaled) {
  auto half = view();
  half->cameraParams.ncols = 1280;
  half->cameraParams.nrows = 960;
  half->cameraParams.setIntrinsicParamsFromValues(1000, 1000, 640.5, 480.5);
  const auto found = DoorSignExtractor({}).signsIn(*half), as_calibrated = DoorSignExtractor({}).signsIn(*view());
  ASSERT_EQ(found->signs.size(), 1u);
  EXPECT_LT((found->signs[0].ray - as_calibrated->signs[0].ray).norm(), 1e-6);
  half->cameraParams.nrows = 720;
  EXPECT_THROW(DoorSignExtractor({}).signsIn(*half), base::Error);
}

void expectNothingSure(const cv::Mat& picture, const std::string& what) {
  auto image = view();
  image->image = mrpt::img::CImage(picture, mrpt::img::DEEP_COPY);
  const auto found = DoorSignExtractor({}).signsIn(*image);
  for (const auto& sign : found->signs)
    for (const auto& text : sign.texts) EXPECT_LT(text.confidence, 0.9) << what << ": " << text.text;
}

TEST_F(DoorSignExtractorTest, whatIsNoReadableTextIsNotSure) {
  const cv::Mat picture = view()->image.asCvMat<cv::Mat>(mrpt::img::DEEP_COPY);
  cv::Mat mirrored, on_its_head, blurred, dim, noise(480, 640, CV_8UC3);
  cv::flip(picture, mirrored, 1);
  expectNothingSure(mirrored, "mirrored");
  cv::flip(picture, on_its_head, -1);
  expectNothingSure(on_its_head, "upside down");
  cv::GaussianBlur(picture, blurred, {}, 9);
  expectNothingSure(blurred, "blurred");
  cv::RNG(1).fill(noise, cv::RNG::UNIFORM, 0, 255);
  expectNothingSure(noise, "noise");
  cv::Mat arrows(480, 640, CV_8UC3, cv::Scalar(150, 170, 180));
  cv::arrowedLine(arrows, {200, 200}, {300, 200}, cv::Scalar(40, 40, 40), 6);
  cv::arrowedLine(arrows, {400, 250}, {400, 180}, cv::Scalar(40, 40, 40), 6);
  expectNothingSure(arrows, "arrows");
}

TEST_F(DoorSignExtractorTest, aLineWithLettersThatTheAlphabetLacksIsNotSure) {
  DoorSignOptions options;
  options.letters = "0123456789";
  options.min_confidence = 0;
  const auto found = DoorSignExtractor(options).signsIn(*view());
  for (const auto& sign : found->signs)
    for (const auto& text : sign.texts) EXPECT_LT(text.confidence, 0.9) << text.text;
  options.letters = "0123\xff";
  EXPECT_THROW(DoorSignExtractor{options}, base::Error);
}

// Lines of letters, which are given by their strokes in cells of 4 x 6 units.
void writeStrokes(cv::Mat& picture, const std::vector<std::vector<std::vector<cv::Point>>>& letters, cv::Point at) {
  constexpr int kUnit = 7;
  for (const auto& letter : letters) {
    for (auto stroke : letter) {
      for (auto& point : stroke) point = at + kUnit * point;
      cv::polylines(picture, stroke, false, cv::Scalar(235, 235, 235), 5, cv::LINE_AA);
    }
    at.x += 6 * kUnit;
  }
}

// "ЖИДЯ" and "ΣΨΞΠ": some of these letters look like K, N, A, R, E and W.
TEST_F(DoorSignExtractorTest, anotherScriptIsNotSure) {
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(150, 170, 180));
  picture(cv::Rect(200, 100, 240, 240)) = cv::Scalar(90, 60, 60);
  writeStrokes(picture,
               {{{{0, 0}, {4, 6}}, {{4, 0}, {0, 6}}, {{2, 0}, {2, 6}}},
                {{{0, 0}, {0, 6}, {4, 0}, {4, 6}}},
                {{{0, 7}, {0, 6}, {4, 6}, {4, 7}}, {{1, 6}, {1, 0}, {3, 0}, {3, 6}}},
                {{{4, 6}, {4, 0}, {1, 0}, {0, 1}, {0, 2}, {1, 3}, {4, 3}}, {{2, 3}, {0, 6}}}},
               {240, 140});
  writeStrokes(picture,
               {{{{4, 0}, {0, 0}, {2, 3}, {0, 6}, {4, 6}}},
                {{{0, 0}, {0, 3}, {4, 3}, {4, 0}}, {{2, 0}, {2, 6}}},
                {{{0, 0}, {4, 0}}, {{1, 3}, {3, 3}}, {{0, 6}, {4, 6}}},
                {{{0, 6}, {0, 0}, {4, 0}, {4, 6}}}},
               {240, 240});
  cv::GaussianBlur(picture, picture, {}, 0.8);
  expectNothingSure(picture, "another script");
}

// Folds in the paper bend the line and press its letters together; a text that is read anyway must be right.
TEST_F(DoorSignExtractorTest, aShirtIsNotReadWronglyAndSure) {
  cv::Mat flat(480, 640, CV_8UC3, cv::Scalar(150, 170, 180)), worn;
  cv::ellipse(flat, {320, 420}, {150, 260}, 0, 0, 360, cv::Scalar(50, 60, 130), cv::FILLED);
  write(flat, "TEAM 47", {240, 300}, 1.3);
  for (const float depth : {3.0f, 6.0f, 12.0f}) {
    cv::Mat columns(flat.size(), CV_32F), rows(flat.size(), CV_32F);
    for (int y = 0; y < flat.rows; ++y) {
      for (int x = 0; x < flat.cols; ++x) {
        const float u = static_cast<float>(x), v = static_cast<float>(y);
        columns.at<float>(y, x) = u + depth * std::sin(u / 11 + v / 40);
        rows.at<float>(y, x) = v + depth * std::sin(u / 17);
      }
    }
    cv::remap(flat, worn, columns, rows, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    auto image = view();
    image->image = mrpt::img::CImage(worn, mrpt::img::DEEP_COPY);
    const auto found = DoorSignExtractor({}).signsIn(*image);
    for (const auto& sign : found->signs) {
      for (const auto& text : sign.texts) {
        const bool is_right = text.text == "TEAM 47" || text.text == "TEAM47";
        EXPECT_TRUE(is_right || text.confidence < 0.9) << text.text;
      }
    }
  }
}

// The lines of a poster are on one plate, and a number among them is not a separate sign.
TEST_F(DoorSignExtractorTest, aPosterWithNumbersIsOneRegion) {
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(150, 170, 180));
  picture(cv::Rect(180, 60, 280, 360)) = cv::Scalar(225, 235, 240);
  const char* lines[] = {"CONCERT", "12 MAY", "HALL 213", "20:30", "12 EUR"};
  for (int i = 0; i < 5; ++i)
    cv::putText(picture, lines[i], {215, 125 + 65 * i}, cv::FONT_HERSHEY_SIMPLEX, 1.2, cv::Scalar(40, 30, 30), 3,
                cv::LINE_AA);
  cv::GaussianBlur(picture, picture, {}, 0.8);
  auto image = view();
  image->image = mrpt::img::CImage(picture, mrpt::img::DEEP_COPY);
  const auto found = DoorSignExtractor({}).signsIn(*image);
  ASSERT_EQ(found->signs.size(), 1u);
  ASSERT_EQ(found->signs[0].texts.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    std::string read = found->signs[0].texts[static_cast<std::size_t>(i)].text, written = lines[i];
    for (auto* text : {&read, &written}) text->erase(std::remove(text->begin(), text->end(), ' '), text->end());
    EXPECT_EQ(read, written);
  }
}

// A weak reflection of a window covers the sign.
TEST_F(DoorSignExtractorTest, aSignBehindGlassIsRead) {
  auto image = view();
  cv::Mat picture = image->image.asCvMat<cv::Mat>(mrpt::img::DEEP_COPY), window(480, 640, CV_8UC3, cv::Scalar::all(0));
  window(cv::Rect(300, 100, 200, 300)) = cv::Scalar(255, 250, 240);
  cv::GaussianBlur(window, window, {}, 8);
  picture = 0.8 * picture + 0.15 * window;
  image->image = mrpt::img::CImage(picture, mrpt::img::DEEP_COPY);
  const auto found = DoorSignExtractor({}).signsIn(*image);
  ASSERT_FALSE(found->signs.empty());
  EXPECT_EQ(found->signs[0].texts[0].text, "26-138");
}

TEST_F(DoorSignExtractorTest, networksThatAreCutOffAreNamed) {
  const testing::ScratchFolder folder;
  DoorSignOptions options;
  options.models = folder.path();
  for (const char* name : {"text_detector.onnx", "text_reader.onnx", "text_reader.letters.txt"})
    std::filesystem::copy_file(net::modelsFolder() + "/" + name, folder / name);
  EXPECT_NO_THROW(DoorSignExtractor{options});
  for (const char* name : {"text_reader.letters.txt", "text_reader.onnx", "text_detector.onnx"}) {
    std::filesystem::resize_file(folder / name, 0);
    try {
      DoorSignExtractor{options};
      ADD_FAILURE() << name;
    } catch (const base::Error& error) {
      EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  }
}

TEST_F(DoorSignExtractorTest, networksThatAreSwappedAreNamed) {
  const testing::ScratchFolder folder;
  DoorSignOptions options;
  options.models = folder.path();
  std::filesystem::copy_file(net::modelsFolder() + "/text_detector.onnx", folder / "text_reader.onnx");
  std::filesystem::copy_file(net::modelsFolder() + "/text_reader.onnx", folder / "text_detector.onnx");
  std::filesystem::copy_file(net::modelsFolder() + "/text_reader.letters.txt", folder / "text_reader.letters.txt");
  const auto refused = [&](const std::string& said) {
    try {
      DoorSignExtractor{options};
      ADD_FAILURE() << said;
    } catch (const base::Error& error) {
      EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
    }
  };
  refused("text_detector.onnx: is not the network that finds text");
  std::filesystem::copy_file(net::modelsFolder() + "/text_detector.onnx", folder / "text_detector.onnx",
                             std::filesystem::copy_options::overwrite_existing);
  refused("text_reader.onnx: is not the network that reads lines");
}

// A dark plate with bright text, like those that the classifier was trained on.
TEST_F(DoorSignExtractorTest, saliencyFindsItToo) {
  DoorSignOptions options;
  options.detector = DoorSignOptions::Detector::saliency;
  try {
    const auto found = DoorSignExtractor(options).signsIn(*view());
    ASSERT_FALSE(found->signs.empty());
    ASSERT_FALSE(found->signs[0].texts.empty());
    EXPECT_EQ(found->signs[0].texts[0].text, "26-138");
    EXPECT_GT(found->signs[0].score, 0.3);
    options.min_score = 1;
    EXPECT_TRUE(DoorSignExtractor(options).signsIn(*view())->signs.empty()) << "no region has a probability as high";
    options.model = "/not/there.svm";
    EXPECT_THROW(DoorSignExtractor{options}, base::Error);
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("libopencv-contrib-dev"), std::string::npos) << error.what();
  }
}

// If Tesseract is not built in, the error says what to install.
TEST_F(DoorSignExtractorTest, tesseractReadsItToo) {
  DoorSignOptions options;
  options.reader = DoorSignOptions::Reader::tesseract;
  try {
    const auto found = DoorSignExtractor(options).signsIn(*view());
    ASSERT_EQ(found->signs.size(), 1u);
    ASSERT_FALSE(found->signs[0].texts.empty());
    EXPECT_EQ(found->signs[0].texts.back().text, "OFFICE");
  } catch (const base::Error& error) {
    EXPECT_NE(std::string(error.what()).find("tesseract-ocr-eng"), std::string::npos) << error.what();
  }
}

TEST(DoorSignExtractor, MissingNetworksAreNamedWithTheRemedy) {
  const testing::ScratchFolder empty;
  DoorSignOptions options;
  options.models = empty.path();
  try {
    DoorSignExtractor{options};
    FAIL();
  } catch (const base::Error& error) {
    EXPECT_EQ(error.code(), base::ExitCode::unreadable_input);
    EXPECT_NE(std::string(error.what()).find("text_detector.onnx"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("scripts/models"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace omnimapper::signs
