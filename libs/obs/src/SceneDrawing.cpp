#include <mrpt/opengl/CArrow.h>
#include <mrpt/opengl/CSphere.h>
#include <mrpt/opengl/CText.h>
#include <mrpt/opengl/CTexturedPlane.h>
#include <omnimapper/geometry/PlaneTangent.h>
#include <omnimapper/obs/SceneDrawing.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::obs {

mrpt::img::TColor indexColour(std::size_t index, std::uint8_t alpha) {
  // Steps of the hue by the golden section keep the colours of neighbouring indices apart.
  const double hue = 6 * std::fmod(0.05 + 0.6180339887498949 * static_cast<double>(index % 1000), 1.0);
  const auto part = [&](double shift) {
    const double position = std::fmod(hue + shift, 6.0);
    const double height = std::clamp(std::min(position, 4 - position), 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255 * (0.1 + 0.8 * height)));
  };
  return {part(2), part(0), part(4), alpha};
}

mrpt::img::TColor asColor(const Rgb& colour) {
  return {colour.red, colour.green, colour.blue};
}

bool isFinite(const Eigen::Vector3d& point) {
  return point.allFinite();
}

void addLine(mrpt::opengl::CSetOfLines& lines, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  if (isFinite(from) && isFinite(to)) lines.appendLine(from.x(), from.y(), from.z(), to.x(), to.y(), to.z());
}

void addClosed(mrpt::opengl::CSetOfLines& lines, const geometry::Polygon3& polygon) {
  const auto& vertices = polygon.vertices;
  for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++)
    addLine(lines, vertices[j], vertices[i]);
}

mrpt::opengl::CSetOfLines::Ptr makeLines(const mrpt::img::TColor& colour, float width) {
  auto lines = mrpt::opengl::CSetOfLines::Create();
  lines->setColor_u8(colour);
  lines->setLineWidth(width);
  return lines;
}

void addStroke(mrpt::opengl::CSetOfTriangles& strokes, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
               double width) {
  const Eigen::Vector3d along = to - from;
  if (!isFinite(from) || !isFinite(to) || !(along.norm() > 1e-9)) return;
  const auto at = [](const Eigen::Vector3d& p) {
    return mrpt::math::TPoint3Df(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
  };
  const auto square = geometry::tangentBasis(along.normalized());
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector3d side = 0.5 * width * square.col(k);
    const auto a = at(from - side), b = at(from + side), c = at(to + side), d = at(to - side);
    strokes.insertTriangle(mrpt::opengl::TTriangle(a, b, c));
    strokes.insertTriangle(mrpt::opengl::TTriangle(a, c, d));
  }
}

void addArrow(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
              const mrpt::img::TColor& colour) {
  const double length = (to - from).norm();
  if (!isFinite(from) || !isFinite(to) || !(length > 1e-3)) return;
  auto arrow = mrpt::opengl::CArrow::Create();
  mrpt::math::CVectorFixedDouble<3> begin, end;
  for (int i = 0; i < 3; ++i) {
    begin[i] = from[i];
    end[i] = to[i];
  }
  arrow->setArrowEnds(begin, end);
  arrow->setSmallRadius(static_cast<float>(0.03 * length));
  arrow->setLargeRadius(static_cast<float>(0.09 * length));
  arrow->enableLight(false);
  arrow->setColor_u8(colour);
  scene.insert(arrow);
}

void addBall(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& middle, double radius,
             const mrpt::img::TColor& colour) {
  if (!isFinite(middle)) return;
  auto ball = mrpt::opengl::CSphere::Create(static_cast<float>(radius));
  ball->setLocation(middle.x(), middle.y(), middle.z());
  ball->enableLight(false);
  ball->setColor_u8(colour);
  scene.insert(ball);
}

void addPicture(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& middle, const Eigen::Vector3d& right,
                const Eigen::Vector3d& down, const mrpt::img::CImage& image) {
  const auto width = static_cast<float>(right.norm()), height = static_cast<float>(down.norm());
  if (!isFinite(middle) || !(width > 0 && height > 0 && std::isfinite(width) && std::isfinite(height))) return;
  auto picture = mrpt::opengl::CTexturedPlane::Create(-width, width, -height, height);
  picture->assignImage(image);
  picture->CRenderizableShaderTexturedTriangles::enableLight(false);
  // The first row of the image is at the lowest y of the picture's frame, so y is down as in the image.
  const Eigen::Vector3d axes[] = {right.normalized(), down.normalized(), right.cross(down).normalized()};
  mrpt::math::CMatrixDouble33 rotation;
  mrpt::math::CVectorFixedDouble<3> place;
  for (int i = 0; i < 3; ++i) {
    for (int axis = 0; axis < 3; ++axis) rotation(i, axis) = axes[axis][i];
    place[i] = middle[i];
  }
  picture->setPose(mrpt::poses::CPose3D(rotation, place));
  scene.insert(picture);
}

void addText(mrpt::opengl::CSetOfObjects& scene, const Eigen::Vector3d& place, const std::string& text,
             const mrpt::img::TColor& colour) {
  if (!isFinite(place) || text.empty()) return;
  auto label = mrpt::opengl::CText::Create(text);
  label->setLocation(place.x(), place.y(), place.z());
  label->setColor_u8(colour);
  scene.insert(label);
}

}  // namespace omnimapper::obs
