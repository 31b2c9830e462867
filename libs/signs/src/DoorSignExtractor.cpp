#include <omnimapper/base/Error.h>
#include <omnimapper/base/FeatureLibraries.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/camera/LensModel.h>
#include <omnimapper/camera/PictureView.h>
#include <omnimapper/net/Network.h>
#include <omnimapper/signs/DoorSignExtractor.h>
#include <omnimapper/signs/SignDetector.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "LineReader.h"
#include "NetworkReader.h"
#include "PictureChanges.h"
#include "PlateFinder.h"
#include "PlateRanges.h"
#include "TextDetector.h"

namespace omnimapper::signs {

using obs::CObservationDoorSigns;
using obs::ObservedDoorSign;

const base::OptionTable<DoorSignOptions>& DoorSignOptions::table() {
  using Options = DoorSignOptions;
  static const auto table =
      base::OptionTable<Options>()
          .choice<Detector>("detector", &Options::detector,
                            {{"text", Detector::text}, {"saliency", Detector::saliency}},
                            "How signs are detected. text: by lines of text. saliency: by salient regions of the image "
                            "and a classifier that was trained on signs, as in the thesis. Both need the networks, "
                            "because these read the signs.")
          .text("model", &Options::model,
                "With detector = saliency, the classifier file written by omnimapper-train-doorsigns; empty uses "
                "the model that is shipped.")
          .number("min_score", &Options::min_score, {0, 1},
                  "With detector = saliency, smallest probability of being a sign at which a region of the image is "
                  "accepted.")
          .text("models", &Options::models,
                "Folder of the networks that scripts/models makes; empty for omnimapper/models in $XDG_DATA_HOME or "
                "~/.local/share. The ONNX Runtime library is always taken from this default folder, because it is "
                "executable code.")
          .choice<Backend>("backend", &Options::backend,
                           {{"opencv", Backend::opencv}, {"onnx_runtime", Backend::onnx_runtime}},
                           "Library that runs the networks: OpenCV, or ONNX Runtime. ONNX Runtime is twice as fast; "
                           "scripts/models --onnxruntime fetches it.")
          .choice<Options::Reader>(
              "reader", &Options::reader,
              {{"network", Options::Reader::network}, {"tesseract", Options::Reader::tesseract}},
              "How the detected lines of text are read: by a network, or by Tesseract, which takes a tenth of "
              "the time and needs larger letters.")
          .text("letters", &Options::letters,
                "Characters that texts consist of; empty for the English alphabet, digits and -.,:/&'(). A middle dot "
                "is read as a hyphen, and a line with a character outside this set is uncertain.")
          .number("min_confidence", &Options::min_confidence, {0, 1},
                  "Lines of text with a lower confidence are left out.")
          .number("min_height_px", &Options::min_height, {4, 1000},
                  "Lines of text whose letters are less high than this in the image are left out.")
          .number("least_change", &Options::least_change, {0, 255},
                  "Each image is reduced to 64 columns and compared with the last image of the same camera that was "
                  "examined. It is examined only if the grey value (0 to 255) of some pixel has changed by more than "
                  "this, apart from the mean change of all pixels. Otherwise omnimapper-perceive reuses the signs of "
                  "that last image. 0 examines every image.");
  return table;
}

namespace {

cv::Mat inBgr(const mrpt::img::CImage& image) {
  const auto pixels = image.asCvMat<cv::Mat>(mrpt::img::SHALLOW_COPY);
  cv::Mat picture;
  if (pixels.type() == CV_8UC1) cv::cvtColor(pixels, picture, cv::COLOR_GRAY2BGR);
  if (pixels.type() == CV_8UC3) picture = pixels;
  return picture;
}

std::optional<Eigen::Vector3d> rayTo(const Corners& quad, const camera::LensModel& lens) {
  camera::Corners corners;
  for (std::size_t i = 0; i < quad.size(); ++i) corners[i] = quad[i].cast<double>();
  const auto rays = lens.raysOf(corners);
  if (!rays) return std::nullopt;
  const auto& r = *rays;
  const Eigen::Vector2d first = r[2] - r[0], second = r[3] - r[1], between = r[1] - r[0];
  const double area = first.x() * second.y() - first.y() * second.x();
  if (!(std::abs(area) > 0)) return std::nullopt;
  const double share = (between.x() * second.y() - between.y() * second.x()) / area;
  const Eigen::Vector2d middle = r[0] + share * first;
  return Eigen::Vector3d(middle.x(), middle.y(), 1).normalized();
}

// Whether the quad leaves the image or touches its edge.
bool leavesImage(const Corners& quad, int columns, int rows) {
  constexpr float kMargin = 1;  // [px]
  return std::any_of(quad.begin(), quad.end(), [&](const Eigen::Vector2f& corner) {
    return corner.minCoeff() < kMargin || corner.x() > static_cast<float>(columns - 1) - kMargin ||
           corner.y() > static_cast<float>(rows - 1) - kMargin;
  });
}

// BGR, as MRPT's images are.
mrpt::img::CImage imageOf(const cv::Mat& patch) {
  return mrpt::img::CImage(patch, mrpt::img::DEEP_COPY);
}

// Throws Error(wrong_type) if these letters are no UTF-8.
std::string validLetters(const std::string& letters) {
  std::string whole;
  for (const auto& letter : lettersOf(letters)) whole += letter;
  if (whole != letters) {
    throw base::Error(base::ExitCode::wrong_type, "letters of door signs: \"" + base::printable(letters) +
                                                      "\" is not valid UTF-8; save the INI as UTF-8");
  }
  return letters.empty() ? Alphabet::common() : letters;
}

}  // namespace

// Detectors and readers, which are made once for all images.
class DoorSignExtractor::Finder {
 public:
  explicit Finder(const DoorSignOptions& options)
      : options_(options),
        salient_(salientDetector()),
        detector_(networkOf("text_detector.onnx")),
        reader_(readerFor(Alphabet(validLetters(options.letters)))) {}

  std::vector<ObservedDoorSign> signsIn(const cv::Mat& picture, const camera::LensModel& lens) const {
    struct Line {
      double score;  // as text
      obs::ReadText text;
    };
    const bool is_salient = salient_ != nullptr;
    std::vector<SignRegion> salient;
    if (is_salient) {
      salient = salient_->detect(
          {picture.data, picture.cols, picture.rows, static_cast<int>(picture.step), camera::ColourImage::Order::bgr});
      if (salient.empty()) return {};
    }
    std::vector<Line> lines;
    std::vector<Corners> quads;
    for (const auto& found : detector_.detect(picture)) {
      if (heightOf(found.quad) < options_.min_height) continue;
      for (const auto& line : readLines(picture, found.quad, *reader_)) {
        if (heightOf(line.quad) < options_.min_height) continue;
        lines.push_back({found.score, {line.reading.text, confidenceOf(line.reading.evidence)}});
        quads.push_back(line.quad);
      }
    }
    std::vector<ObservedDoorSign> signs;
    for (const auto& plate : is_salient ? platesOf(salient, quads) : findPlates(picture, quads)) {
      const auto ray = rayTo(plate.quad, lens);
      if (!ray) continue;
      ObservedDoorSign sign;
      sign.corners_px = plate.quad;
      sign.ray = *ray;
      sign.is_cut = leavesImage(plate.quad, picture.cols, picture.rows);
      if (is_salient) sign.score = plate.score;
      for (const auto line : plate.lines) {
        const auto& text = lines[line].text;
        if (text.confidence < options_.min_confidence) continue;
        sign.texts.push_back(text);
        if (!is_salient) sign.score = std::max(sign.score, lines[line].score);
      }
      if (sign.texts.empty() && !is_salient) continue;
      const cv::Mat patch = patchOf(picture, plate.quad);
      if (!patch.empty()) sign.patch = imageOf(patch);
      signs.push_back(std::move(sign));
    }
    std::stable_sort(signs.begin(), signs.end(), [](const auto& a, const auto& b) {
      return middleOf(a.corners_px).x() < middleOf(b.corners_px).x();
    });
    return signs;
  }

 private:
  std::string folder() const { return options_.models.empty() ? net::modelsFolder() : options_.models; }

  // The ONNX Runtime library is executable code, so it is taken only from the default folder, even if an INI names
  // another folder of networks.
  std::shared_ptr<const net::Network> networkOf(const std::string& file) const {
    const bool is_opencv = options_.backend == DoorSignOptions::Backend::opencv;
    return std::make_shared<net::Network>(folder() + "/" + file,
                                          is_opencv ? net::Backend::opencv : net::Backend::onnx_runtime,
                                          is_opencv ? "" : net::modelsFolder() + "/libonnxruntime.so.1");
  }

  std::unique_ptr<const TextReader> readerFor(const Alphabet& alphabet) const {
    if (options_.reader == DoorSignOptions::Reader::network)
      return std::make_unique<NetworkReader>(networkOf("text_reader.onnx"), folder() + "/text_reader.letters.txt",
                                             alphabet);
    // By default Tesseract starts more threads than it can use, so that a line takes five times as long. It reads the
    // limit when its library is loaded.
    setenv("OMP_THREAD_LIMIT", "1", 0);
    const auto make = reinterpret_cast<TextReader* (*)(const Alphabet&)>(
        base::functionOfFeature("omnimapperTesseractReader", "Tesseract cannot read", "leave reader = tesseract out"));
    return std::unique_ptr<const TextReader>(make(alphabet));
  }

  // Assigns each line to the best region that contains its middle.
  static std::vector<Plate> platesOf(const std::vector<SignRegion>& regions, const std::vector<Corners>& lines) {
    std::vector<Plate> plates;
    for (const auto& region : regions) plates.push_back({region.corners_px, region.score, {}});
    for (std::size_t line = 0; line < lines.size(); ++line) {
      const auto plate = std::find_if(plates.begin(), plates.end(),
                                      [&](const Plate& p) { return contains(p.quad, middleOf(lines[line])); });
      if (plate != plates.end()) plate->lines.push_back(line);
    }
    return plates;
  }

  std::unique_ptr<const SignDetector> salientDetector() const {
    if (options_.detector == DoorSignOptions::Detector::text) return nullptr;
    const auto make = reinterpret_cast<SignDetector* (*)(const std::string&, double)>(base::functionOfFeature(
        "omnimapperSalientSignDetector", "door signs cannot be found by saliency", "leave detector = saliency out"));
    return std::unique_ptr<const SignDetector>(make(options_.model, options_.min_score));
  }

  DoorSignOptions options_;
  std::unique_ptr<const SignDetector> salient_;  // null if signs are detected by lines of text
  TextDetector detector_;
  std::unique_ptr<const TextReader> reader_;
};

namespace {

void measureRanges(const mrpt::obs::CObservation3DRangeScan& scan, const camera::LensModel& lens,
                   std::vector<ObservedDoorSign>& signs) {
  try {
    const PlateRanges ranges(scan, lens);
    for (auto& sign : signs) {
      const auto measured = ranges.of(sign.corners_px, sign.ray);
      if (!measured) continue;
      sign.range = measured->range;
      sign.range_sigma = measured->sigma;
    }
  } catch (const base::Error&) {
    // Without depths, or with a depth camera that is not calibrated, the signs have no range.
  }
}

// Scales a calibration to an image of another size but the same field of view.
mrpt::img::TCamera fittingCamera(mrpt::img::TCamera camera, const cv::Mat& picture, const std::string& label) {
  const auto columns = static_cast<unsigned>(picture.cols), rows = static_cast<unsigned>(picture.rows);
  if (camera.ncols == 0 || camera.nrows == 0 || (camera.ncols == columns && camera.nrows == rows)) return camera;
  const double wider = (1.0 * columns / rows) / (1.0 * camera.ncols / camera.nrows);
  constexpr double kSameShape = 0.01;
  if (std::abs(wider - 1) > kSameShape) {
    throw base::Error(base::ExitCode::unreadable_input,
                      label + ": its images have " + std::to_string(columns) + " x " + std::to_string(rows) +
                          " pixels, and the camera was calibrated with " + std::to_string(camera.ncols) + " x " +
                          std::to_string(camera.nrows) + "; calibrate it with the images that it sends");
  }
  const double x = 1.0 * columns / camera.ncols, y = 1.0 * rows / camera.nrows;
  camera.setIntrinsicParamsFromValues(x * camera.fx(), y * camera.fy(), (camera.cx() + 0.5) * x - 0.5,
                                      (camera.cy() + 0.5) * y - 0.5);
  camera.ncols = columns;
  camera.nrows = rows;
  return camera;
}

}  // namespace

DoorSignExtractor::DoorSignExtractor(const DoorSignOptions& options)
    : least_change_(options.least_change), finder_(std::make_unique<Finder>(options)) {}

DoorSignExtractor::~DoorSignExtractor() = default;

CObservationDoorSigns::Ptr DoorSignExtractor::signsIn(const mrpt::obs::CObservation& raw) const {
  const auto view = camera::pictureOf(raw);
  auto observation = CObservationDoorSigns::Create();
  observation->timestamp = raw.timestamp;
  observation->sensorLabel = raw.sensorLabel + kSignsSuffix;
  observation->source_label = raw.sensorLabel;
  observation->sensorPose = view.pose;
  if (view.image == nullptr) return observation;
  try {
    const cv::Mat picture = inBgr(*view.image);
    if (picture.empty()) return observation;
    const camera::LensModel lens(fittingCamera(*view.camera, picture, raw.sensorLabel), raw.sensorLabel);
    observation->signs = finder_->signsIn(picture, lens);
    const auto* depth_scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&raw);
    if (depth_scan != nullptr && !observation->signs.empty()) measureRanges(*depth_scan, lens, observation->signs);
  } catch (const cv::Exception& error) {
    throw base::Error(base::ExitCode::unreadable_input,
                      raw.sensorLabel + ": OpenCV cannot look for signs in this image: " + error.err);
  }
  return observation;
}

bool DoorSignExtractor::wants(const mrpt::obs::CObservation& raw) const {
  return camera::bringsPicture(raw);
}

std::vector<mrpt::obs::CObservation::Ptr> DoorSignExtractor::extract(const mrpt::obs::CObservation& raw) const {
  return {signsIn(raw)};
}

std::unique_ptr<perception::Novelty> DoorSignExtractor::novelty() const {
  if (least_change_ == 0) return nullptr;
  return std::make_unique<PictureChanges>(least_change_);
}

std::vector<perception::DerivedName> DoorSignExtractor::namesOf(const mrpt::obs::CObservation& raw) const {
  return {{CLASS_ID(CObservationDoorSigns), raw.sensorLabel + kSignsSuffix}};
}

}  // namespace omnimapper::signs
