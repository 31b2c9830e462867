#include "Outlines.h"

#include <omnimapper/geometry/Simplify.h>

#include <utility>

namespace omnimapper::perception::planes {

namespace {

// Directions along pixel edges, in the order of right turns.
enum Direction { up, right, down, left };
constexpr int kStepX[] = {0, 1, 0, -1};
constexpr int kStepY[] = {-1, 0, 1, 0};
// For each direction, offsets from a corner to the pixel ahead on the right and to the pixel ahead on the left.
constexpr int kRightX[] = {0, 0, -1, -1}, kRightY[] = {-1, 0, 0, -1};
constexpr int kLeftX[] = {-1, 0, 0, -1}, kLeftY[] = {-1, -1, 0, 0};

class Tracer {
 public:
  Tracer(const std::vector<std::uint16_t>& labels, int width, int height)
      : labels_(labels.data()), width_(width), height_(height), traced_(labels.size(), false) {}

  bool isTraced(int x, int y) const { return traced_[index(x, y)]; }

  // Traces a line that starts downwards along the left edge of the pixel and has the region on its left.
  TracedLine trace(int x, int y) {
    TracedLine line;
    line.label = labels_[index(x, y)];
    const PixelCorner start{x, y};
    PixelCorner at = start;
    int direction = down;
    // The line is closed when it returns to its first edge, not to its first corner: it may pass a corner twice.
    do {
      if (direction == down) traced_[index(at.x, at.y)] = true;
      at.x += kStepX[direction];
      at.y += kStepY[direction];
      line.area -= at.x * kStepY[direction];  // upward edges add the pixels to their left, downward ones subtract them
      const int next = turn(at, direction, line.label);
      if (next != direction) line.corners.push_back(at);
      direction = next;
    } while (!(at == start) || direction != down);
    return line;
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  bool has(int x, int y, std::uint16_t label) const {
    return x >= 0 && y >= 0 && x < width_ && y < height_ && labels_[index(x, y)] == label;
  }

  // Pixels that only touch at a corner are not connected, so a left turn is tried first.
  int turn(const PixelCorner& at, int direction, std::uint16_t label) const {
    if (!has(at.x + kLeftX[direction], at.y + kLeftY[direction], label)) return (direction + 3) % 4;
    if (has(at.x + kRightX[direction], at.y + kRightY[direction], label)) return (direction + 1) % 4;
    return direction;
  }

  const std::uint16_t* labels_;
  int width_, height_;
  std::vector<bool> traced_;  // for each pixel, whether its left edge was traced
};

}  // namespace

std::vector<TracedLine> traceOutlines(const std::vector<std::uint16_t>& labels, int width, int height,
                                      const std::vector<PixelRun>& runs, int min_hole) {
  std::vector<TracedLine> lines;
  Tracer tracer(labels, width, height);
  for (const PixelRun& run : runs) {
    const auto pixel = static_cast<std::size_t>(run.row) * static_cast<std::size_t>(width);
    const auto begin = pixel + static_cast<std::size_t>(run.begin);
    // A run that goes on to the left of its begin has no edge there.
    if (run.begin > 0 && labels[begin - 1] == labels[begin]) continue;
    if (labels[begin] == 0 || tracer.isTraced(run.begin, run.row)) continue;
    TracedLine line = tracer.trace(run.begin, run.row);
    if (line.area > 0 || -line.area >= min_hole) lines.push_back(std::move(line));
  }
  return lines;
}

std::vector<std::size_t> cornersNeeded(const std::vector<PixelCorner>& corners, double tolerance) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(corners.size());
  for (const PixelCorner& corner : corners) points.emplace_back(corner.x, corner.y);
  return geometry::keptOfLoop(points, tolerance);
}

}  // namespace omnimapper::perception::planes
