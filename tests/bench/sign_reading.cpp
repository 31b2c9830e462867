// How well the lines of simulated door signs are read, and whether the confidences agree with the share of right lines.
//
//   omnimapper-simulate -i rawlogs/signs_30.ini --set simulation.sensors=camera -o out/signs_30
//   bench-sign_reading out/signs_30 --evidence out/signs_30.csv
//
// Each line is compared with the sign that signs_seen.csv has at that position of the image. It is right if it consists
// of some of the words of one line of that sign, in their order, and of nothing else.
#include <mrpt/obs/CObservationImage.h>
#include <omnimapper/base/Stamp.h>
#include <omnimapper/net/Network.h>
#include <omnimapper/source/RawlogSource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <opencv2/core.hpp>
#include <sstream>

#include "LineReader.h"
#include "NetworkReader.h"
#include "TextDetector.h"

namespace {

using namespace omnimapper;

struct TrueSign {
  signs::Corners quad;
  std::vector<std::string> lines;
  double capitals = 0, incidence = 0, visible = 0;
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::stringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

// The true signs of each image, by its number.
std::map<int, std::vector<TrueSign>> readTruth(const std::string& file) {
  std::map<int, std::vector<TrueSign>> truth;
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    line.erase(std::remove(line.begin(), line.end(), '"'), line.end());
    const auto fields = split(line, ',');
    const auto n = fields.size();  // a text may hold commas
    if (n < 19) continue;
    TrueSign sign;
    std::string text = fields[4];
    for (std::size_t i = 5; i + 14 < n; ++i) text += "," + fields[i];
    sign.lines = split(text, '|');
    for (std::size_t i = 0; i < 4; ++i)
      sign.quad[i] = {std::stof(fields[n - 14 + 2 * i]), std::stof(fields[n - 13 + 2 * i])};
    sign.capitals = std::stod(fields[n - 6]);
    sign.incidence = std::stod(fields[n - 3]);
    sign.visible = std::stod(fields[n - 2]);
    truth[std::stoi(fields[2])].push_back(sign);
  }
  return truth;
}

bool isOf(const std::string& text, const std::string& line) {
  const auto words = split(line, ' ');
  const auto plain = [](std::string s) {
    s.erase(std::remove(s.begin(), s.end(), ' '), s.end());
    return s;
  };
  for (std::size_t first = 0; first < words.size(); ++first) {
    std::string joined;
    for (std::size_t last = first; last < words.size(); ++last) {
      joined += words[last];
      if (joined == plain(text)) return true;
    }
  }
  return false;
}

struct Read {
  std::string text, truth;
  double confidence = 0;
  bool is_right = false;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Evaluates how well the lines of simulated door signs are read.");
  std::vector<std::string> folders;
  std::string evidence;
  bool by_opencv = false;
  app.add_option("folders", folders, "folders that omnimapper-simulate wrote")->required();
  app.add_option("--evidence", evidence,
                 "CSV file for the features from which the confidence of each reading is computed");
  app.add_flag("--opencv", by_opencv, "run the networks with OpenCV");
  CLI11_PARSE(app, argc, argv);
  const auto models = net::modelsFolder();
  const auto network = [&](const std::string& name) {
    return std::make_shared<net::Network>(models + "/" + name,
                                          by_opencv ? net::Backend::opencv : net::Backend::onnx_runtime,
                                          by_opencv ? "" : models + "/libonnxruntime.so.1");
  };
  const signs::TextDetector detector(network("text_detector.onnx"));
  const signs::NetworkReader reader(network("text_reader.onnx"), models + "/text_reader.letters.txt",
                                    signs::Alphabet(signs::Alphabet::common()));
  std::ofstream table;
  if (!evidence.empty()) {
    table.open(evidence);
    table << "place,text,truth,right,confidence,weakest,agreement,clearance,height,capitals,incidence,visible\n";
  }
  constexpr int kBins = 10;
  std::vector<int> all(kBins), right(kBins);
  int sure = 0, sure_and_right = 0, elsewhere = 0;
  // Counts of whole signs by the height of their capitals in steps of 4 px: all, first line read, and that with a high
  // confidence.
  std::map<int, std::array<int, 3>> by_height;
  for (const auto& folder : folders) {
    const auto name = folder.substr(folder.find_last_of('/') + 1);
    const auto truth = readTruth(folder + "/signs_seen.csv");
    std::string log;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".rawlog") log = entry.path();
    source::RawlogSource source(log);
    int measurement = -1;
    while (const auto observation = source.next()) {
      const auto image = std::dynamic_pointer_cast<mrpt::obs::CObservationImage>(observation);
      if (!image) continue;
      ++measurement;
      const auto picture = image->image.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
      const auto found = truth.find(measurement);
      const std::vector<TrueSign> true_signs = found == truth.end() ? std::vector<TrueSign>() : found->second;
      std::vector<double> best(true_signs.size(), -1);
      std::vector<signs::ReadLine> lines;
      for (const auto& text : detector.detect(picture)) {
        if (signs::heightOf(text.quad) < 8) continue;
        for (auto& line : signs::readLines(picture, text.quad, reader)) lines.push_back(std::move(line));
      }
      for (const auto& [quad, reading] : lines) {
        const auto middle = signs::middleOf(quad);
        const auto sign = std::find_if(true_signs.begin(), true_signs.end(),
                                       [&](const TrueSign& s) { return signs::contains(s.quad, middle); });
        if (sign == true_signs.end()) {
          ++elsewhere;
          continue;
        }
        const double confidence = signs::confidenceOf(reading.evidence);
        const bool is_right = std::any_of(sign->lines.begin(), sign->lines.end(),
                                          [&](const auto& truly) { return isOf(reading.text, truly); });
        if (is_right && isOf(reading.text, sign->lines.front())) {
          auto& b = best[static_cast<std::size_t>(sign - true_signs.begin())];
          b = std::max(b, confidence);
        }
        const auto bin = static_cast<std::size_t>(std::min(kBins - 1, static_cast<int>(confidence * kBins)));
        ++all[bin];
        right[bin] += is_right;
        if (confidence >= 0.9) {
          ++sure;
          sure_and_right += is_right;
        }
        if (!table.is_open()) continue;
        std::string truly;
        for (const auto& l : sign->lines) truly += (truly.empty() ? "" : "|") + l;
        const auto& e = reading.evidence;
        table << name << ",\"" << reading.text << "\",\"" << truly << "\"," << is_right << ',' << confidence << ','
              << e.weakest_letter << ',' << e.agreement << ',' << e.clearance << ',' << e.height_px << ','
              << sign->capitals << ',' << sign->incidence << ',' << sign->visible << '\n';
      }
      for (std::size_t i = 0; i < true_signs.size(); ++i) {
        const auto& s = true_signs[i];
        const bool is_whole =
            s.visible > 0.99 && s.incidence < 60 && std::all_of(s.quad.begin(), s.quad.end(), [&](const auto& corner) {
              return corner.x() > 0 && corner.y() > 0 && corner.x() < static_cast<float>(picture.cols) &&
                     corner.y() < static_cast<float>(picture.rows);
            });
        if (!is_whole) continue;
        auto& counts = by_height[static_cast<int>(s.capitals / 4) * 4];
        ++counts[0];
        counts[1] += best[i] >= 0;
        counts[2] += best[i] >= 0.9;
      }
    }
  }
  std::printf("| confidence | lines | right |\n|---|---|---|\n");
  for (int i = 0; i < kBins; ++i)
    std::printf("| %.1f to %.1f | %d | %d, %.1f %% |\n", 0.1 * i, 0.1 * (i + 1), all[i], right[i],
                100.0 * right[i] / std::max(1, all[i]));
  std::printf("\nat least 0.9: %d of %d right, %.2f %%; lines elsewhere: %d\n\n", sure_and_right, sure,
              100.0 * sure_and_right / std::max(1, sure), elsewhere);
  std::printf("| capitals [px] | whole signs under 60 deg | first line read | and sure |\n|---|---|---|---|\n");
  for (const auto& [height, counts] : by_height)
    std::printf("| %d to %d | %d | %.0f %% | %.0f %% |\n", height, height + 4, counts[0], 100.0 * counts[1] / counts[0],
                100.0 * counts[2] / counts[0]);
  return 0;
}
