#include <omnimapper/base/Error.h>
#include <omnimapper/obs/CObservationDoorSigns.h>
#include <omnimapper/obs/SceneDrawing.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "Fields.h"
#include "TextRow.h"

IMPLEMENTS_SERIALIZABLE(CObservationDoorSigns, mrpt::obs::CObservation, omnimapper::obs)

namespace omnimapper::obs {

namespace {

constexpr double kDrawnRange = 2;  // [m] of a sign whose range was not measured
constexpr double kDrawnHeight = 0.25;

// Writes width, height [px] and channels, then the rows. MRPT's own format is JPEG, which would lose detail.
void writePatch(Archive& out, const mrpt::img::CImage& patch) {
  const std::size_t width = patch.isEmpty() ? 0 : patch.getWidth(), height = patch.isEmpty() ? 0 : patch.getHeight();
  if (width > UINT16_MAX || height > UINT16_MAX)
    throw base::Error(base::ExitCode::internal, "CObservationDoorSigns: a patch is wider or higher than 65535 pixels.");
  const std::size_t channels = width > 0 && patch.isColor() ? 3 : 1;
  out << static_cast<std::uint16_t>(width) << static_cast<std::uint16_t>(height) << static_cast<std::uint8_t>(channels);
  if (width == 0) return;
  for (std::size_t y = 0; y < height; ++y) {
    out.WriteBuffer(patch.ptrLine<std::uint8_t>(static_cast<unsigned>(y)), width * channels);
  }
}

mrpt::img::CImage readPatch(Archive& in) {
  const std::size_t width = readNumber<std::uint16_t>(in), height = readNumber<std::uint16_t>(in);
  const std::size_t channels = readNumber<std::uint8_t>(in);
  if (channels != 1 && channels != 3) {
    throw base::Error(base::ExitCode::damaged_input, "CObservationDoorSigns: a patch has " + std::to_string(channels) +
                                                         " channels; there must be 1 or 3.");
  }
  if (width == 0 || height == 0) return {};
  const auto bytes = readBytes(in, width * height * channels);
  mrpt::img::CImage patch(static_cast<unsigned>(width), static_cast<unsigned>(height),
                          channels == 3 ? mrpt::img::CH_RGB : mrpt::img::CH_GRAY);
  for (std::size_t y = 0; y < height; ++y) {
    std::memcpy(patch.ptrLine<std::uint8_t>(static_cast<unsigned>(y)), bytes.data() + y * width * channels,
                width * channels);
  }
  return patch;
}

void writeReadText(Archive& out, const ReadText& text) {
  writeText(out, text.text);
  out << text.confidence;
}

ReadText readReadText(Archive& in) {
  ReadText text;
  text.text = readText(in);
  text.confidence = readNumber<double>(in);
  return text;
}

void writeDouble(Archive& out, double value) {
  out << value;
}

void writeSign(Archive& out, const ObservedDoorSign& sign) {
  for (const auto& corner : sign.corners_px) writeMatrix(out, corner);
  writeMatrix(out, sign.ray);
  writeOptional(out, sign.range, writeDouble);
  out << sign.range_sigma << sign.score;
  writeItems(out, sign.texts, writeReadText);
  writePatch(out, sign.patch);
}

ObservedDoorSign readSign(Archive& in) {
  ObservedDoorSign sign;
  for (auto& corner : sign.corners_px) corner = readMatrix<Eigen::Vector2f>(in);
  sign.ray = readMatrix<Eigen::Vector3d>(in);
  sign.range = readOptional(in, readNumber<double>);
  sign.range_sigma = readNumber<double>(in);
  sign.score = readNumber<double>(in);
  sign.texts = readItems(in, readReadText);
  sign.patch = readPatch(in);
  return sign;
}

// Draws the patch with a frame, at right angles to the ray and upright as in the image.
void drawPatch(mrpt::opengl::CSetOfObjects& scene, const ObservedDoorSign& sign, const Eigen::Vector3d& middle,
               const mrpt::img::TColor& colour) {
  Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(sign.ray);
  if (!isFinite(middle) || !(right.norm() > 1e-6)) return;
  right.normalize();
  const Eigen::Vector3d down = sign.ray.cross(right);
  const bool has_patch = !sign.patch.isEmpty();
  const double shape = has_patch ? double(sign.patch.getWidth()) / double(sign.patch.getHeight()) : 1.5;
  const double half_height = 0.5 * kDrawnHeight, half_width = half_height * std::clamp(shape, 0.2, 5.0);
  geometry::Polygon3 frame;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    frame.vertices.push_back(middle + x * half_width * right + y * half_height * down);
  auto edges = makeLines(colour, 4);
  addClosed(*edges, frame);
  scene.insert(edges);
  if (!has_patch) return;
  addPicture(scene, middle, half_width * right, half_height * down, sign.patch);
}

std::string textOf(const ObservedDoorSign& sign) {
  std::string text;
  for (const auto& line : sign.texts) text += (text.empty() ? "" : " / ") + line.text;
  return text;
}

}  // namespace

uint8_t CObservationDoorSigns::serializeGetVersion() const {
  return 1;
}

void CObservationDoorSigns::serializeTo(mrpt::serialization::CArchive& out) const {
  writeHead(out);
  writeItems(out, signs, writeSign);
  for (const auto& sign : signs) out << static_cast<std::uint8_t>(sign.is_cut);
}

void CObservationDoorSigns::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
  if (version > 1) refuseVersion("CObservationDoorSigns", version);
  readHead(in);
  signs = readItems(in, readSign);
  for (auto& sign : signs) {
    // Version 0 has neither this flag nor the size of the image.
    const auto& corners = sign.corners_px;
    sign.is_cut = version > 0 ? readNumber<std::uint8_t>(in) != 0
                              : std::any_of(corners.begin(), corners.end(),
                                            [](const auto& corner) { return corner.minCoeff() < 0; });
  }
}

void CObservationDoorSigns::describe(std::ostream& out) const {
  out << signs.size() << " door signs, in the frame of the camera (z forward, x right, y down):\n";
  for (std::size_t i = 0; i < signs.size(); ++i) {
    const auto& sign = signs[i];
    out << i << ": ray " << shortly(sign.ray.x()) << " " << shortly(sign.ray.y()) << " " << shortly(sign.ray.z());
    if (sign.is_cut) out << ", cut by the edge of the image";
    if (sign.range) out << ", range " << shortly(*sign.range) << " +- " << shortly(sign.range_sigma) << " m";
    out << ", score " << shortly(sign.score) << ", corners [px]";
    for (const auto& corner : sign.corners_px) out << " (" << corner.x() << ", " << corner.y() << ")";
    if (sign.patch.isEmpty()) {
      out << ", no patch\n";
    } else {
      out << ", patch of " << sign.patch.getWidth() << " x " << sign.patch.getHeight() << " px\n";
    }
    for (const auto& line : sign.texts)
      out << "   \"" << inAscii(line.text) << "\" with confidence " << shortly(line.confidence) << "\n";
  }
}

std::string CObservationDoorSigns::exportTxtHeader() const {
  return "signs { corner_0_x_px corner_0_y_px corner_1_x_px corner_1_y_px corner_2_x_px corner_2_y_px corner_3_x_px "
         "corner_3_y_px ray_x ray_y ray_z range_m range_sigma_m score patch_width_px patch_height_px texts { text "
         "confidence } }";
}

std::string CObservationDoorSigns::exportTxtDataRow() const {
  TextRow row;
  row.whole(static_cast<long long>(signs.size()));
  for (const auto& sign : signs) {
    for (const auto& corner : sign.corners_px) row.vector(Eigen::Vector2d(corner.cast<double>()));
    row.vector(sign.ray).number(sign.range ? *sign.range : std::numeric_limits<double>::quiet_NaN());
    row.number(sign.range_sigma).number(sign.score);
    const bool has_patch = !sign.patch.isEmpty();
    row.whole(has_patch ? static_cast<long long>(sign.patch.getWidth()) : 0);
    row.whole(has_patch ? static_cast<long long>(sign.patch.getHeight()) : 0);
    row.whole(static_cast<long long>(sign.texts.size()));
    for (const auto& line : sign.texts) row.text(line.text).number(line.confidence);
  }
  return row.str();
}

void CObservationDoorSigns::draw(mrpt::opengl::CSetOfObjects& scene_in_sensor) const {
  for (std::size_t i = 0; i < signs.size(); ++i) {
    const auto& sign = signs[i];
    const double range = sign.range.value_or(kDrawnRange);
    const Eigen::Vector3d middle = range * sign.ray;
    auto ray = makeLines(indexColour(i), 2);
    addLine(*ray, Eigen::Vector3d::Zero(), middle);
    scene_in_sensor.insert(ray);
    if (sign.range && sign.range_sigma > 0) {
      auto uncertain = makeLines(indexColour(i), 6);
      addLine(*uncertain, std::max(0.0, range - 2 * sign.range_sigma) * sign.ray,
              (range + 2 * sign.range_sigma) * sign.ray);
      scene_in_sensor.insert(uncertain);
    }
    drawPatch(scene_in_sensor, sign, middle, indexColour(i));
    addText(scene_in_sensor, middle - Eigen::Vector3d(0, 0.6 * kDrawnHeight, 0), inAscii(textOf(sign)), indexColour(i));
  }
}

}  // namespace omnimapper::obs
