#include <mrpt/opengl/stock_objects.h>
#include <omnimapper/derived/SceneParts.h>
#include <omnimapper/derived/SessionColours.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::derived {

namespace {

using mrpt::img::TColor;
using namespace mrpt::opengl;

// [m] heights above the ground; they differ so that no line hides another.
constexpr float kRefusedHeight = 0.01f, kAcceptedHeight = 0.02f, kTrajectoryHeight = 0.03f;
constexpr double kBorder = 5;  // [m]

void appendLine(CSetOfLines& lines, const mrpt::math::TPoint3D& a, const mrpt::math::TPoint3D& b, float height) {
  lines.appendLine(a.x, a.y, a.z + height, b.x, b.y, b.z + height);
}

}  // namespace

CGridPlaneXY::Ptr groundOf(const map::Map& map) {
  mrpt::math::TPoint3D low(0, 0, 0), high(0, 0, 0);
  if (!map.key_frames.empty()) low = high = map.key_frames.front().map_from_base.translation();
  for (const map::KeyFrame& frame : map.key_frames) {
    const auto p = frame.map_from_base.translation();
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
  }
  const double size = std::max(high.x - low.x, high.y - low.y) + 2 * kBorder;
  double step = 1;
  while (size / step > 100) step *= step == 2 ? 2.5 : 2;  // 1 2 5 10 20 40 ...
  const auto down = [&](double v) { return static_cast<float>(step * std::floor((v - kBorder) / step)); };
  const auto up = [&](double v) { return static_cast<float>(step * std::ceil((v + kBorder) / step)); };
  auto ground = CGridPlaneXY::Create(down(low.x), up(high.x), down(low.y), up(high.y), static_cast<float>(low.z),
                                     static_cast<float>(step), 1.0f);
  ground->setName("ground");
  ground->setColor_u8(TColor(190, 196, 204));
  return ground;
}

CSetOfObjects::Ptr trajectoryLines(const std::vector<map::StampedPose>& trajectory) {
  const auto linesOf = [](const char* name, const draw::Rgb& colour) {
    auto lines = CSetOfLines::Create();
    lines->setName(name);
    lines->setColor_u8(TColor(colour.r, colour.g, colour.b));
    lines->setLineWidth(3);
    return lines;
  };
  const auto newest = linesOf("newest session", kNewestSession),
             earlier = linesOf("earlier sessions", kEarlierSessions);
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    if (trajectory[i].session != trajectory[i - 1].session) continue;
    appendLine(trajectory[i].session == trajectory.back().session ? *newest : *earlier,
               trajectory[i - 1].map_from_base.translation(), trajectory[i].map_from_base.translation(),
               kTrajectoryHeight);
  }
  auto group = CSetOfObjects::Create();
  group->setName("trajectory");
  if (earlier->size() > 0) group->insert(earlier);
  group->insert(newest);
  return group;
}

CSetOfObjects::Ptr keyFrameCorners(const map::Map& map, double spacing) {
  auto corners = CSetOfObjects::Create();
  corners->setName("key frames");
  double travel = spacing;
  for (std::size_t i = 0; i < map.key_frames.size(); ++i) {
    const auto& pose = map.key_frames[i].map_from_base;
    if (i > 0) travel += (pose.translation() - map.key_frames[i - 1].map_from_base.translation()).norm();
    const bool newest = i + 1 == map.key_frames.size();
    if (travel < spacing && !newest) continue;
    travel = 0;
    auto corner = stock_objects::CornerXYZSimple(newest ? 1.0f : 0.4f, newest ? 3.0f : 1.0f);
    corner->setPose(pose);
    corners->insert(corner);
  }
  return corners;
}

CSetOfLines::Ptr closureLines(const std::vector<Closure>& closures, bool accepted) {
  auto lines = CSetOfLines::Create();
  lines->setName(accepted ? "closures" : "refused closures");
  lines->setColor_u8(accepted ? TColor(22, 163, 74) : TColor(220, 60, 50, 90));
  lines->setLineWidth(accepted ? 2 : 1);
  for (const Closure& closure : closures) {
    if (closure.decision->accepted == accepted) {
      appendLine(*lines, closure.from, closure.to, accepted ? kAcceptedHeight : kRefusedHeight);
    }
  }
  return lines;
}

CPointCloudColoured::Ptr cloudOf(const std::vector<ColouredPoint>& points) {
  auto cloud = CPointCloudColoured::Create();
  cloud->setName("points");
  cloud->setPointSize(2);
  cloud->resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [p, colour] = points[i];
    cloud->setPoint(i, mrpt::math::TPointXYZfRGBAu8(p.x, p.y, p.z, colour.r, colour.g, colour.b));
  }
  return cloud;
}

}  // namespace omnimapper::derived
