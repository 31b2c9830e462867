#pragma once

#include <Eigen/Core>
#include <ostream>
#include <string>
#include <vector>

namespace omnimapper::draw {

/// An SVG drawing in pixels, x to the right and y down. Each function writes its element at once; the destructor writes
/// the end of the drawing.
class Svg {
 public:
  Svg(std::ostream& out, double width, double height);
  ~Svg();
  Svg(const Svg&) = delete;
  Svg& operator=(const Svg&) = delete;

  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const std::string& colour, double width);
  /// A point less than a third of a pixel from the last drawn one is left out, unless it is the last point.
  void polyline(const std::vector<Eigen::Vector2d>& points, const std::string& colour, double width);
  /// An area with a border of that width, half of it inside, and pointed corners; 0 for none.
  void polygon(const std::vector<Eigen::Vector2d>& corners, const std::string& fill, const std::string& border,
               double width);
  void box(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const std::string& fill);
  void dot(const Eigen::Vector2d& centre, double radius, const std::string& fill);
  enum class Anchor { start, middle, end };
  void text(const Eigen::Vector2d& at, const std::string& text, Anchor anchor, double size = 12);

 private:
  std::ostream& out_;
};

/// The colour of a share in [0, 1], as "#rrggbb": dark blue at 0, then green and yellow, and red at 1.
std::string heatColour(double share);

/// The rectangle of a drawing in which values are shown, with its axes.
class Axes {
 public:
  /// `corner` (upper left) and `size` are in pixels. The rectangle shows values from `low` (left, bottom) to `high`
  /// (right, top).
  Axes(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const Eigen::Vector2d& low,
       const Eigen::Vector2d& high);
  /// Axes with the same scale in both directions; the range from `low` to `high` is in the middle of the rectangle.
  static Axes withEqualScale(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const Eigen::Vector2d& low,
                             const Eigen::Vector2d& high);

  Eigen::Vector2d pixel(const Eigen::Vector2d& value) const;
  /// Draws a grid, numbers at round values, and the names of the axes.
  void draw(Svg& svg, const std::string& x_name, const std::string& y_name) const;
  const Eigen::Vector2d& low() const { return low_; }
  const Eigen::Vector2d& high() const { return high_; }

 private:
  Eigen::Vector2d corner_, size_, low_, high_;
};

/// Round values (1, 2 or 5 times a power of ten apart) in [low, high], about `count` of them, for the ticks of an axis.
/// If the range has no extent, only `low`.
std::vector<double> roundValues(double low, double high, int count);

}  // namespace omnimapper::draw
