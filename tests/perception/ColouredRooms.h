#pragma once

#include <omnimapper/obs/Rgb.h>

#include <algorithm>
#include <array>

#include "DepthRooms.h"

namespace omnimapper::perception::rooms {

/// A room of randomRoom() with sheets on its walls and floor, half a millimetre thick, and the colour of each face.
struct ColouredRoom {
  Scene scene;
  std::vector<std::array<double, 3>> colours;  ///< red, green, blue of each face, up to 255
};

inline std::array<double, 3> randomColour(testing::Dice& dice) {
  return {dice.uniform(40, 230), dice.uniform(40, 230), dice.uniform(40, 230)};
}

/// The colour of each sheet differs by at least 80 from that of the face it lies on.
inline ColouredRoom colouredRoom(testing::Dice& dice, int sheets = 8) {
  ColouredRoom room{randomRoom(dice), {}};
  for (std::size_t i = 0; i < room.scene.faces.size(); ++i) room.colours.push_back(randomColour(dice));
  for (int i = 0; i < sheets; ++i) {
    const int below = i % 5;  // the room's four walls and its floor are the first faces
    const Face wall = room.scene.faces[static_cast<std::size_t>(below)];
    const Eigen::Vector3d normal = wall.half_a.cross(wall.half_b).normalized();
    Face sheet{wall.middle + dice.uniform(-0.8, 0.8) * wall.half_a + dice.uniform(-0.8, 0.8) * wall.half_b,
               dice.uniform(0.15, 0.4) * wall.half_a.normalized(), dice.uniform(0.15, 0.4) * wall.half_b.normalized()};
    sheet.middle -= 5e-4 * (normal.dot(wall.middle) > 0 ? 1 : -1) * normal;
    room.scene.faces.push_back(sheet);
    const auto& under = room.colours[static_cast<std::size_t>(below)];
    std::array<double, 3> colour{};
    do {
      colour = randomColour(dice);
    } while (std::hypot(colour[0] - under[0], colour[1] - under[1], colour[2] - under[2]) < 80);
    room.colours.push_back(colour);
  }
  return room;
}

/// A picture in the view of the depth image: light falls off by 40 % from one corner to the opposite one, edges are
/// three pixels wide, and the noise is 4 of 256 steps.
inline std::vector<obs::Rgb> picture(const ColouredRoom& room, const View& view, testing::Dice& dice) {
  const int width = room.scene.width, height = room.scene.height;
  const auto lit = [&](int x, int y, std::size_t channel) {
    double sum = 0;
    for (int v = y - 1; v <= y + 1; ++v) {
      for (int u = x - 1; u <= x + 1; ++u) {
        const int pixel = std::clamp(v, 0, height - 1) * width + std::clamp(u, 0, width - 1);
        const std::uint16_t face = view.face[static_cast<std::size_t>(pixel)];
        if (face > 0) sum += room.colours[face - 1U][channel] / 9;
      }
    }
    return sum * (1 - 0.2 * x / width - 0.2 * y / height);
  };
  std::vector<obs::Rgb> colours;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto channel = [&](std::size_t k) {
        return static_cast<std::uint8_t>(std::clamp(lit(x, y, k) + dice.normal(4), 0.0, 255.0));
      };
      const std::uint8_t red = channel(0), green = channel(1), blue = channel(2);
      colours.push_back({red, green, blue});
    }
  }
  return colours;
}

}  // namespace omnimapper::perception::rooms
