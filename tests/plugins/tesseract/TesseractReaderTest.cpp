#include <gtest/gtest.h>
#include <tesseract/baseapi.h>

#include <opencv2/imgproc.hpp>
#include <thread>

#include "tesseract/TesseractReader.h"

namespace omnimapper::tesseract_reader {
namespace {

cv::Mat lineOf(const std::string& text, const cv::Scalar& ink, const cv::Scalar& ground) {
  cv::Mat patch(40, 26 * static_cast<int>(text.size()) + 20, CV_8UC3, ground);
  cv::putText(patch, text, {10, 32}, cv::FONT_HERSHEY_DUPLEX, 1.1, ink, 2, cv::LINE_AA);
  return patch;
}

signs::Reading read(const TesseractReader& reader, const cv::Mat& patch) {
  return reader.read(
      {patch.data, patch.cols, patch.rows, static_cast<int>(patch.step), camera::ColourImage::Order::bgr});
}

const cv::Scalar kDark(60, 40, 40), kLight(230, 225, 220);

TEST(TesseractReader, readsDarkAndLightLines) {
  const TesseractReader reader{signs::Alphabet(signs::Alphabet::common())};
  for (const bool is_dark : {true, false}) {
    const auto reading = read(reader, lineOf("213", is_dark ? kDark : kLight, is_dark ? kLight : kDark));
    EXPECT_EQ(reading.text, "213");
    ASSERT_EQ(reading.probabilities.size(), 3u);
    for (const double probability : reading.probabilities) {
      EXPECT_GT(probability, 0.5);
      EXPECT_LE(probability, 1);
    }
  }
  EXPECT_EQ(read(reader, lineOf("OFFICE", kDark, kLight)).text, "OFFICE");
}

TEST(TesseractReader, readsLettersOfTheAlphabetAlone) {
  const TesseractReader reader{signs::Alphabet("0123456789")};
  for (const char c : read(reader, lineOf("OFFICE", kDark, kLight)).text) EXPECT_TRUE(std::isdigit(c) || c == ' ') << c;
}

TEST(TesseractReader, threadsReadAlike) {
  const TesseractReader reader{signs::Alphabet(signs::Alphabet::common())};
  const auto patch = lineOf("26-138", kDark, kLight);
  const auto expected = read(reader, patch);
  std::vector<signs::Reading> readings(3);
  std::vector<std::thread> threads;
  for (auto& reading : readings) threads.emplace_back([&] { reading = read(reader, patch); });
  for (auto& thread : threads) thread.join();
  for (const auto& reading : readings) {
    EXPECT_EQ(reading.text, expected.text);
    EXPECT_EQ(reading.probabilities, expected.probabilities);
  }
}

TEST(TesseractReader, patchesWithoutTextAreRead) {
  const TesseractReader reader{signs::Alphabet(signs::Alphabet::common())};
  EXPECT_EQ(reader.read({}).text, "");
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 300), cv::Size(3000, 2)}) {
    const auto reading = read(reader, cv::Mat(size, CV_8UC3, kLight));
    EXPECT_EQ(signs::lettersOf(reading.text).size(), reading.probabilities.size()) << size;
  }
}

}  // namespace
}  // namespace omnimapper::tesseract_reader
