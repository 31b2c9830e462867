#include <omnimapper/base/Numbers.h>
#include <omnimapper/draw/Markup.h>
#include <omnimapper/draw/Svg.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace omnimapper::draw {

namespace {

std::string pixels(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

}  // namespace

Svg::Svg(std::ostream& out, double width, double height) : out_(out) {
  out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << pixels(width) << " " << pixels(height)
       << "\" width=\"" << pixels(width) << "\" height=\"" << pixels(height)
       << "\" font-family=\"DejaVu Sans, Helvetica, Arial, sans-serif\">\n";
  box({0, 0}, {width, height}, "#ffffff");
}

Svg::~Svg() {
  out_ << "</svg>\n";
}

void Svg::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const std::string& colour, double width) {
  out_ << "<line x1=\"" << pixels(from.x()) << "\" y1=\"" << pixels(from.y()) << "\" x2=\"" << pixels(to.x())
       << "\" y2=\"" << pixels(to.y()) << "\" stroke=\"" << colour << "\" stroke-width=\"" << pixels(width)
       << "\" stroke-linecap=\"round\"/>\n";
}

void Svg::polyline(const std::vector<Eigen::Vector2d>& points, const std::string& colour, double width) {
  out_ << "<polyline fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"" << pixels(width)
       << "\" stroke-linejoin=\"round\" points=\"";
  const Eigen::Vector2d* last = nullptr;
  for (const auto& point : points) {
    if (last && (point - *last).norm() < 1.0 / 3 && &point != &points.back()) continue;
    out_ << pixels(point.x()) << "," << pixels(point.y()) << " ";
    last = &point;
  }
  out_ << "\"/>\n";
}

void Svg::polygon(const std::vector<Eigen::Vector2d>& corners, const std::string& fill, const std::string& border,
                  double width) {
  out_ << "<polygon fill=\"" << fill << "\" stroke=\"" << border << "\" stroke-width=\"" << pixels(width)
       << "\" points=\"";
  for (const auto& corner : corners) out_ << pixels(corner.x()) << "," << pixels(corner.y()) << " ";
  out_ << "\"/>\n";
}

void Svg::box(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const std::string& fill) {
  out_ << "<rect x=\"" << pixels(corner.x()) << "\" y=\"" << pixels(corner.y()) << "\" width=\"" << pixels(size.x())
       << "\" height=\"" << pixels(size.y()) << "\" fill=\"" << fill << "\"/>\n";
}

void Svg::dot(const Eigen::Vector2d& centre, double radius, const std::string& fill) {
  out_ << "<circle cx=\"" << pixels(centre.x()) << "\" cy=\"" << pixels(centre.y()) << "\" r=\"" << pixels(radius)
       << "\" fill=\"" << fill << "\"/>\n";
}

void Svg::text(const Eigen::Vector2d& at, const std::string& text, Anchor anchor, double size) {
  const char* name = anchor == Anchor::start ? "start" : anchor == Anchor::middle ? "middle" : "end";
  out_ << "<text x=\"" << pixels(at.x()) << "\" y=\"" << pixels(at.y()) << "\" font-size=\"" << pixels(size)
       << "\" fill=\"#333333\" text-anchor=\"" << name << "\">" << escapeMarkup(text) << "</text>\n";
}

std::string heatColour(double share) {
  using Colour = std::array<double, 3>;
  static const std::array<Colour, 5> stops = {Colour{40, 60, 140}, Colour{30, 140, 150}, Colour{110, 190, 80},
                                              Colour{240, 190, 50}, Colour{210, 40, 40}};
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double blend = place - static_cast<double>(below);
  std::array<int, 3> rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    rgb[i] = static_cast<int>(std::lround((1 - blend) * stops[below][i] + blend * stops[below + 1][i]));
  }
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", rgb[0] & 255, rgb[1] & 255, rgb[2] & 255);
  return text;
}

Axes::Axes(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const Eigen::Vector2d& low,
           const Eigen::Vector2d& high)
    : corner_(corner), size_(size), low_(low), high_(high) {
  for (int i = 0; i < 2; ++i) {
    if (!(high_[i] > low_[i])) high_[i] = low_[i] + 1;
  }
}

Axes Axes::withEqualScale(const Eigen::Vector2d& corner, const Eigen::Vector2d& size, const Eigen::Vector2d& low,
                          const Eigen::Vector2d& high) {
  const Eigen::Vector2d middle = 0.5 * (low + high);
  const double scale = std::max({((high - low).array() / size.array()).maxCoeff() * 1.08, 1e-3 / size.maxCoeff()});
  return Axes(corner, size, middle - 0.5 * scale * size, middle + 0.5 * scale * size);
}

Eigen::Vector2d Axes::pixel(const Eigen::Vector2d& value) const {
  const Eigen::Array2d share = (value - low_).array() / (high_ - low_).array();
  return {corner_.x() + share.x() * size_.x(), corner_.y() + (1 - share.y()) * size_.y()};
}

void Axes::draw(Svg& svg, const std::string& x_name, const std::string& y_name) const {
  const double left = corner_.x(), top = corner_.y(), right = left + size_.x(), bottom = top + size_.y();
  for (const double value : roundValues(low_.x(), high_.x(), 8)) {
    const double x = pixel({value, low_.y()}).x();
    svg.line({x, top}, {x, bottom}, "#e4e4e4", 1);
    svg.text({x, bottom + 17}, base::brief(value, 6), Svg::Anchor::middle);
  }
  for (const double value : roundValues(low_.y(), high_.y(), size_.y() > 300 ? 8 : 4)) {
    const double y = pixel({low_.x(), value}).y();
    svg.line({left, y}, {right, y}, "#e4e4e4", 1);
    svg.text({left - 7, y + 4}, base::brief(value, 6), Svg::Anchor::end);
  }
  svg.line({left, bottom}, {right, bottom}, "#555555", 1);
  svg.line({left, top}, {left, bottom}, "#555555", 1);
  svg.text({0.5 * (left + right), bottom + 36}, x_name, Svg::Anchor::middle);
  svg.text({left, top - 9}, y_name, Svg::Anchor::middle);
}

std::vector<double> roundValues(double low, double high, int count) {
  // There are no round values between numbers that differ only by rounding, nor up to infinity.
  if (!(high - low > 1e-9 * std::max(std::abs(low), std::abs(high)))) return {low};
  const double rough = (high - low) / std::max(1, count), power = std::pow(10, std::floor(std::log10(rough)));
  const double mantissa = rough / power;
  const double step = power * (mantissa <= 1 ? 1 : mantissa <= 2 ? 2 : mantissa <= 5 ? 5 : 10);
  std::vector<double> values;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    values.push_back(i == 0 ? 0 : i * step);
  return values;
}

}  // namespace omnimapper::draw
