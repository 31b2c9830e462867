#include <algorithm>
#include <cmath>

#include "Arrangement.h"
#include "WallThings.h"

namespace omnimapper::sim {

using Eigen::Vector2d;

std::vector<const Room*> Arrangement::corridors() const {
  std::vector<const Room*> corridors;
  for (const Room& room : building_.rooms) {
    if (room.kind == "corridor") corridors.push_back(&room);
  }
  return corridors;
}

void Arrangement::repeatSigns(int count) {
  static constexpr const char* kWords[] = {"Storage", "Women", "Men"};
  std::vector<SignPlan*> signs;
  for (SignPlan& sign : plan.signs) {
    if (!has(sign.room)) signs.push_back(&sign);
  }
  const int all = static_cast<int>(signs.size()), some = std::min(count, all);
  for (int i = 0; i < some; ++i)
    signs[static_cast<std::size_t>((2 * i + 1) * all / (2 * some))]->lines = {kWords[i % 3]};
}

void Arrangement::exitSigns() {
  const auto halls = corridors();
  Ring corners;
  for (const Room* hall : halls) corners.insert(corners.end(), hall->outline.begin(), hall->outline.end());
  if (corners.empty()) return;
  const Bounds all = boundsOf(corners);
  for (const Room* hall : halls) {
    const Bounds bounds = boundsOf(hall->outline);
    const Vector2d size = bounds.high - bounds.low, centre = (bounds.low + bounds.high) / 2,
                   out = centre - (all.low + all.high) / 2;
    const Vector2d axis = size.x() > size.y() ? Vector2d::UnitX() : Vector2d::UnitY();
    const bool is_clockwise = out.x() * axis.y() <= out.y() * axis.x();
    exitSignAhead(centre, is_clockwise ? axis : -axis);
  }
}

void Arrangement::exitSignAhead(const Vector2d& from, const Vector2d& direction) {
  const WallFace* nearest = nullptr;
  double range = std::numeric_limits<double>::infinity();
  for (const WallFace& wall : building_.walls) {
    const double towards = -wall.inward().dot(direction), to_wall = wall.distanceTo(from) / towards;
    if (towards < 1e-6 || to_wall < 0 || to_wall >= range) continue;
    const double u = wall.alongOf(from + to_wall * direction);
    const bool is_open = std::any_of(wall.holes.begin(), wall.holes.end(), [&](const WallFace::Hole& hole) {
      return hole.is_from_floor && u > hole.low_u && u < hole.high_u;
    });
    if (u < 0 || u > wall.length || is_open) continue;
    nearest = &wall;
    range = to_wall;
  }
  if (!nearest) return;
  const auto place =
      hang(*nearest, nearest->alongOf(from + range * direction), usualHeight(SignStyle::exit), 0.32, 0.2);
  if (!place) return;
  SignPlan sign;
  sign.name = newName("exit");
  sign.lines = {"EXIT"};
  sign.style = "exit";
  sign.at = *place;
  plan.signs.push_back(sign);
}

void Arrangement::announcements(int count) {
  const auto rooms = corridors();
  for (int i = 0; i < count && !rooms.empty(); ++i) {
    constexpr double kGolden = 0.618033988749895;  // spreads the shares evenly, however many there are
    const double share = std::fmod(kGolden * (i + 1), 1.0), width = 0.42, height = 0.594;
    const auto place = freeWall(rooms[static_cast<std::size_t>(i) % rooms.size()]->name, share, 1.5, width, height);
    if (place) plan.posters.push_back({newName("announcement"), "announcement", *place, width, height});
  }
}

}  // namespace omnimapper::sim
