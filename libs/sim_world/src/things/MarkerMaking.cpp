#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/MarkerMaking.h>

#include <cmath>
#include <opencv2/aruco.hpp>

#include "SignPlate.h"
#include "TextureDrawing.h"

namespace omnimapper::sim {

namespace {

constexpr int kPixelsPerBit = 32;
// White margin around the black square, as a part of its side. OpenCV 4.6 takes two outlines whose corners are nearer
// than 5 % of the perimeter for one and keeps the outer: with less than 0.14 of a side the outline of the plate would
// hide the marker.
constexpr double kMargin = 0.2;

cv::Ptr<cv::aruco::Dictionary> dictionaryOf(MarkerDictionary dictionary) {
  return cv::aruco::getPredefinedDictionary(dictionary == MarkerDictionary::dict_4x4_50 ? cv::aruco::DICT_4X4_50
                                                                                        : cv::aruco::DICT_6X6_250);
}

}  // namespace

MarkerDictionary markerDictionaryOf(const std::string& name) {
  if (name == "4x4_50") return MarkerDictionary::dict_4x4_50;
  if (name == "6x6_250") return MarkerDictionary::dict_6x6_250;
  throw base::Error(base::ExitCode::out_of_range,
                    "dictionary of markers '" + name + "' is unknown; there are 4x4_50, 6x6_250");
}

MadeMarker makeMarker(const MarkerSpec& spec) {
  const auto dictionary = dictionaryOf(spec.dictionary);
  if (spec.id < 0 || spec.id >= dictionary->bytesList.rows) {
    throw base::Error(base::ExitCode::out_of_range,
                      "marker '" + spec.name + "': id " + std::to_string(spec.id) + " is not in its dictionary of " +
                          std::to_string(dictionary->bytesList.rows) + ", 0 is the first");
  }
  if (!(spec.side > 0)) {
    throw base::Error(base::ExitCode::out_of_range,
                      "marker '" + spec.name + "': side " + std::to_string(spec.side) + " m must be positive");
  }
  const int black_side = (dictionary->markerSize + 2) * kPixelsPerBit,
            margin = static_cast<int>(std::lround(kMargin * black_side)), all_side = black_side + 2 * margin;
  cv::Mat black;
  dictionary->drawMarker(spec.id, black_side, black, 1);
  Texture picture = blankTexture(all_side, all_side, Colour::Ones());
  for (int y = 0; y < black.rows; ++y) {
    for (int x = 0; x < black.cols; ++x) {
      setPixel(picture, x + margin, y + margin, Colour::Constant(black.at<std::uint8_t>(y, x) > 127 ? 1.0f : 0.0f));
    }
  }
  const double plate_side = spec.side * all_side / black_side;
  Body body = makePlate({spec.name, SurfaceKind::marker, std::make_shared<const Texture>(std::move(picture)),
                         plate_side, plate_side, kMarkerThickness, Colour::Ones(), spec.map_from_marker});
  return {std::move(body), {spec.name, spec.id, spec.side}};
}

}  // namespace omnimapper::sim
