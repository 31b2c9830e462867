// Times the thesis's method for finding door signs in pictures: salient regions, which a support vector machine
// classifies. Also prints the number of regions.
//
//   bench-sign_saliency out/signs/dark out/signs/white ../shared/data/signs/photos --width 1280
//
// A folder has JPEG or PNG pictures. Times are processor times of one thread, the shortest of three.

#include <omnimapper/base/Error.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <limits>
#include <opencv2/core.hpp>

#include "Timing.h"
#include "salient_signs/Pixels.h"
#include "salient_signs/SalientSignDetector.h"

namespace fs = std::filesystem;
using namespace omnimapper;

namespace {

std::vector<std::string> picturesOf(const std::string& folder) {
  std::vector<std::string> paths;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if ((extension == ".jpg" || extension == ".png") && entry.path().stem().extension() != ".mask")
      paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

template <class Work>
double leastTimeOf(const Work& work) {
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < 3; ++i) {
    const double begin = bench::processorTime();
    work();
    least = std::min(least, bench::processorTime() - begin);
  }
  return least;
}

void report(const std::string& folder, int width) {
  const signs::SaliencyProposer proposer({});
  const signs::SignClassifier classifier = signs::SignClassifier::known();
  std::vector<double> finding, classifying, all, regions;
  for (const auto& path : picturesOf(folder)) {
    mrpt::img::CImage image;
    if (!image.loadFromFile(path)) throw base::Error(base::ExitCode::unreadable_input, path + ": is not a picture");
    if (width > 0) {
      const auto height = image.getHeight() * static_cast<unsigned>(width) / image.getWidth();
      image.scaleImage(image, static_cast<unsigned>(width), static_cast<unsigned>(height), mrpt::img::IMG_INTERP_AREA);
    }
    const auto pixels = signs::pixelsOf(image);
    std::vector<signs::Corners> found;
    finding.push_back(leastTimeOf([&] { found = proposer.propose(pixels); }));
    classifying.push_back(leastTimeOf([&] { classifier.probabilities(pixels, found); }));
    all.push_back(finding.back() + classifying.back());
    regions.push_back(static_cast<double>(found.size()));
  }
  std::printf("| %s | %zu | %.0f | %.1f | %.1f | %.1f | %.1f |\n", fs::path(folder).filename().c_str(), all.size(),
              bench::quantile(regions, 0.5), bench::quantile(finding, 0.5), bench::quantile(classifying, 0.5),
              bench::quantile(all, 0.5), bench::quantile(all, 0.95));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Times the detection of door signs by saliency.");
  std::vector<std::string> folders;
  int width = 0;
  app.add_option("folders", folders, "folders of pictures")->required();
  app.add_option("--width", width, "width to which pictures are scaled first [px]; 0: not scaled")
      ->check(CLI::Range(0, 8192));
  CLI11_PARSE(app, argc, argv);
  cv::setNumThreads(1);
  std::printf(
      "| pictures | count | regions | finding them [ms] | classifying them [ms] | both, median | both, 95 %% |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  try {
    for (const auto& folder : folders) report(folder, width);
  } catch (const std::exception& error) {
    std::cerr << "bench-sign_saliency: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
