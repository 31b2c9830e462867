#include "NetworkReader.h"

#include <omnimapper/base/Error.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <opencv2/imgproc.hpp>

namespace omnimapper::signs {

NetworkReader::NetworkReader(std::shared_ptr<const net::Network> network, const std::string& letters_file,
                             const Alphabet& alphabet)
    : network_(std::move(network)), letters_{""} {
  const auto refuse = [](const std::string& file, const std::string& why) {
    throw base::Error(base::ExitCode::unreadable_input,
                      file + ": " + why + "; scripts/models --force fetches the networks and their letters");
  };
  std::ifstream file(letters_file);
  for (std::string letter; std::getline(file, letter);) {
    if (lettersOf(letter) != std::vector<std::string>{letter})
      refuse(letters_file + ":" + std::to_string(letters_.size()), "is not one letter in UTF-8");
    letters_.push_back(alphabet.letterFor(letter));
  }
  if (letters_.size() < 2) refuse(letters_file, "has no letters");
  const auto shape = [&]() -> std::vector<int> {
    try {
      return network_->run({{1, 3, kRows, kColumns}, std::vector<float>(3 * kRows * kColumns)}).shape;
    } catch (const base::Error&) {
      return {};  // the network takes another input
    }
  }();
  if (shape.size() != 3) refuse(network_->path(), "is not the network that reads lines");
  if (shape[2] != static_cast<int>(letters_.size())) {
    refuse(letters_file, "has " + std::to_string(letters_.size() - 1) + " letters, but " + network_->path() + " has " +
                             std::to_string(shape[2] - 1));
  }
}

Reading NetworkReader::read(const camera::ColourImage& image) const {
  if (image.width < 1 || image.height < 1) return {};
  const cv::Mat patch(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels),
                      static_cast<std::size_t>(image.stride));
  const int columns =
      std::clamp(static_cast<int>(std::ceil(1.0 * kRows * patch.cols / patch.rows)), 1, static_cast<int>(kColumns));
  cv::Mat line;
  cv::resize(patch, line, {columns, kRows});
  net::Tensor input{{1, 3, kRows, kColumns}, std::vector<float>(3 * kRows * kColumns)};
  for (int channel = 0; channel < 3; ++channel) {
    for (int row = 0; row < kRows; ++row) {
      const auto* pixels = line.ptr<cv::Vec3b>(row);
      float* values = input.values.data() + (channel * kRows + row) * kColumns;
      for (int column = 0; column < columns; ++column)
        values[column] = static_cast<float>(pixels[column][channel]) / 127.5f - 1;
    }
  }
  const auto output = network_->run(input);
  return decodeSteps(output.values.data(), output.shape[1], letters_);
}

Reading decodeSteps(const float* probabilities, int steps, const std::vector<std::string>& letters) {
  Reading reading;
  std::size_t before = 0;
  for (int step = 0; step < steps; ++step, probabilities += letters.size()) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < letters.size(); ++i)
      if (!letters[i].empty() && probabilities[i] > probabilities[best]) best = i;
    if (*std::max_element(probabilities, probabilities + letters.size()) > probabilities[best])
      reading.of_left_out = std::min(reading.of_left_out, static_cast<double>(probabilities[best]));
    if (best != 0 && best != before) {
      reading.text += letters[best];
      reading.probabilities.push_back(static_cast<double>(probabilities[best]));
    }
    before = best;
  }
  return reading;
}

}  // namespace omnimapper::signs
