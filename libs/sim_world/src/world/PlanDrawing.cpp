#include <omnimapper/base/Numbers.h>
#include <omnimapper/draw/Markup.h>
#include <omnimapper/sim_world/PlanDrawing.h>
#include <omnimapper/sim_world/Triangulate.h>

#include <algorithm>
#include <cmath>

namespace omnimapper::sim {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

struct Drawing {
  std::string svg;
  Vector2d low, high;
  double scale;

  std::string at(const Vector2d& p) const {
    return base::fixed((p.x() - low.x()) * scale, 1) + "," + base::fixed((high.y() - p.y()) * scale, 1);
  }
  void polygon(const std::vector<Vector2d>& ring, const std::string& style) {
    svg += "<polygon points=\"";
    for (const Vector2d& p : ring) svg += at(p) + " ";
    svg += "\" style=\"" + style + "\"/>\n";
  }
  void line(const std::vector<Vector2d>& points, const std::string& style) {
    svg += "<polyline points=\"";
    for (const Vector2d& p : points) svg += at(p) + " ";
    svg += "\" style=\"fill:none;" + style + "\"/>\n";
  }
  void dot(const Vector2d& p, double radius, const std::string& style) {
    svg += "<circle cx=\"" + base::fixed((p.x() - low.x()) * scale, 1) + "\" cy=\"" +
           base::fixed((high.y() - p.y()) * scale, 1) + "\" r=\"" + base::fixed(radius, 1) + "\" style=\"" + style +
           "\"/>\n";
  }
  void text(const Vector2d& p, double size, const std::string& words) {
    svg += "<text x=\"" + base::fixed((p.x() - low.x()) * scale, 1) + "\" y=\"" +
           base::fixed((high.y() - p.y()) * scale, 1) + "\" font-size=\"" + base::fixed(size, 1) +
           "\" font-family=\"DejaVu Sans\" text-anchor=\"middle\" fill=\"#333\">" + words + "</text>\n";
  }
};

std::string colourOf(const Material& material, double mix_with_white) {
  std::string text = "rgb(";
  Eigen::Vector3f colour = material.colour;
  if (material.texture) {
    Eigen::Vector3f sum = Eigen::Vector3f::Zero();
    constexpr int kSamples = 12;
    for (int i = 0; i < kSamples * kSamples; ++i)
      sum += material.texture->at((i % kSamples + 0.5f) / kSamples, (i / kSamples + 0.5f) / kSamples);
    colour = colour.cwiseProduct(sum / (kSamples * kSamples));
  }
  for (int i = 0; i < 3; ++i) {
    const double shown = std::pow(std::clamp(static_cast<double>(colour[i]), 0.0, 1.0), 1 / 2.2);
    text += std::to_string(static_cast<int>(std::lround(255 * (shown + (1 - shown) * mix_with_white)))) +
            (i < 2 ? "," : ")");
  }
  return text;
}

// Names of rooms have underscores where people write spaces.
std::string labelOf(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return draw::escapeMarkup(name);
}

// Draws the faces of a body that are seen from above, the lower ones first.
void drawBody(const Body& body, const geometry::Se3& map_from_body, double mix, Drawing& drawing) {
  struct Part {
    double z;
    int surface;
    std::vector<Vector2d> corners;
  };
  std::vector<Part> parts;
  for (const Triangle& triangle : body.triangles) {
    Part part{0, triangle.surface, {}};
    for (const int corner : triangle.corners) {
      const Vector3d p = map_from_body * body.vertices_in_body[corner];
      part.z += p.z() / 3;
      part.corners.push_back(p.head<2>());
    }
    if (doubleArea(part.corners) > 1e-5) parts.push_back(std::move(part));
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.z < b.z; });
  std::vector<std::string> colours;
  for (const Surface& surface : body.surfaces) colours.push_back(colourOf(surface.material, mix));
  for (const Part& part : parts) {
    const std::string& colour = colours[part.surface];
    drawing.polygon(part.corners, "fill:" + colour + ";stroke:" + colour + ";stroke-width:0.5");
  }
}

void drawWalls(const Body& body, const geometry::Se3& map_from_body, Drawing& drawing) {
  for (const Surface& surface : body.surfaces) {
    if (!surface.face || surface.kind != SurfaceKind::wall) continue;
    // The foot of the wall: edges of its outline that are not upright, near its bottom.
    const auto& outline = surface.face->outline_in_body;
    const double lowest = map_from_body.translation.z() +
                          std::min_element(outline.begin(), outline.end(), [](const Vector3d& a, const Vector3d& b) {
                            return a.z() < b.z();
                          })->z();
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vector3d a = map_from_body * outline[i], b = map_from_body * outline[(i + 1) % outline.size()];
      const double length = (b - a).head<2>().norm();
      if (length < 1e-6 || std::min(a.z(), b.z()) > lowest + 0.5 + 0.3 * length) continue;
      drawing.line({a.head<2>(), b.head<2>()}, "stroke:#111;stroke-width:2");
    }
  }
}

void drawItems(const World& world, double time, Drawing& drawing) {
  for (const Body& body : world.bodies) {
    const auto pose = body.track.at(time);
    if (!pose || body.surfaces.empty()) continue;
    const SurfaceKind kind = body.surfaces.front().kind;
    const bool hangs = kind == SurfaceKind::sign || kind == SurfaceKind::poster || kind == SurfaceKind::marker;
    if (!hangs) continue;
    const Vector2d at = pose->translation.head<2>(), out = (pose->rotation * Vector3d::UnitZ()).head<2>();
    const Vector2d along = (pose->rotation * Vector3d::UnitX()).head<2>();
    const std::string colour = kind == SurfaceKind::sign     ? "#1040c0"
                               : kind == SurfaceKind::marker ? "#c02020"
                                                             : "#d09000";
    drawing.polygon(
        {at - 0.15 * along, at + 0.15 * along, at + 0.15 * along + 0.1 * out, at - 0.15 * along + 0.1 * out},
        "fill:" + colour);
  }
  for (const PointLandmark& landmark : world.point_landmarks) {
    if (landmark.body.empty()) drawing.dot(landmark.in_body.head<2>(), 4, "fill:#108010");
  }
}

void drawScale(Drawing& drawing) {
  const double span = drawing.high.x() - drawing.low.x();
  const double length = span > 60 ? 10 : span > 20 ? 5 : 1;
  const Vector2d from = drawing.low + Vector2d(0.3, 0.3);
  drawing.line({from, from + Vector2d(length, 0)}, "stroke:#000;stroke-width:3");
  drawing.text(from + Vector2d(length / 2, 8 / drawing.scale), 13, base::brief(length) + " m");
}

}  // namespace

std::string drawPlan(const World& world, const PlanDrawingOptions& options) {
  Drawing drawing;
  drawing.low = Vector2d::Constant(1e9);
  drawing.high = -drawing.low;
  for (const Room& room : world.rooms) {
    for (const Vector2d& p : room.outline) {
      drawing.low = drawing.low.cwiseMin(p);
      drawing.high = drawing.high.cwiseMax(p);
    }
  }
  if (world.rooms.empty()) drawing.low = drawing.high = Vector2d::Zero();
  drawing.low -= Vector2d(0.8, 1.2);
  drawing.high += Vector2d(0.8, 0.8);
  drawing.scale = options.pixels_per_metre;
  const Vector2d size = (drawing.high - drawing.low) * drawing.scale;
  const std::string extent = "width=\"" + base::fixed(size.x(), 0) + "\" height=\"" + base::fixed(size.y(), 0) + "\"";
  drawing.svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" " + extent + ">\n<rect " + extent + " fill=\"#fff\"/>\n";

  for (const auto& obstacle : world.obstacles) drawing.polygon(obstacle, "fill:#999;stroke:none");
  for (const Body& body : world.bodies) {
    const bool is_room =
        std::any_of(world.rooms.begin(), world.rooms.end(), [&](const Room& room) { return room.name == body.name; });
    const auto pose = body.track.at(options.time);
    if (!pose) continue;
    if (!is_room) {
      drawBody(body, *pose, 0.15, drawing);
      continue;
    }
    std::vector<Vector2d> floor;
    for (const Vector3d& p : body.surfaces.front().face->outline_in_body) floor.push_back(p.head<2>());
    drawing.polygon(floor, "fill:" + colourOf(body.surfaces.front().material, 0.75));
  }
  for (const auto& obstacle : world.obstacles) drawing.polygon(obstacle, "fill:none;stroke:#666;stroke-width:0.7");
  for (const Body& body : world.bodies) {
    if (const auto pose = body.track.at(options.time)) drawWalls(body, *pose, drawing);
  }
  drawItems(world, options.time, drawing);
  for (const auto& path : options.paths_of_people) drawing.line(path, "stroke:#2060c0;stroke-width:1");
  if (!options.path.empty()) drawing.line(options.path, "stroke:#d02080;stroke-width:1.5");
  for (const Room& room : world.rooms) {
    Vector2d low = room.outline.front(), high = low;
    for (const Vector2d& p : room.outline) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const std::string words = labelOf(room.name);
    const double fit = 1.4 * (high - low).x() * drawing.scale / std::max<std::size_t>(words.size(), 1);
    if (fit > 5) drawing.text((low + high) / 2, std::min(16.0, fit), words);
  }
  drawScale(drawing);
  return drawing.svg + "</svg>\n";
}

}  // namespace omnimapper::sim
