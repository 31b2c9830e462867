#include <omnimapper/base/Error.h>
#include <omnimapper/camera/DepthDistortion.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace omnimapper::camera {

using mrpt::obs::CObservation3DRangeScan;

namespace {

using Polynomials = std::array<double, DepthDistortion::kMostDegree + 1>;

Polynomials legendreUpTo(int degree, double x) {
  Polynomials p{1, x};
  for (int n = 2; n <= degree; ++n) {
    const auto i = static_cast<std::size_t>(n);
    p[i] = ((2 * n - 1) * x * p[i - 1] - (n - 1) * p[i - 2]) / n;
  }
  return p;
}

// Maps the middle of a pixel to [-1, 1].
double normalized(int pixel, int size) {
  return (2.0 * pixel + 1) / size - 1;
}

constexpr float kSaturatedUnits = 65535;

// `error` [1/m] is added to the inverse of each range. The loop has no branches, so that it is vectorized.
void correctRanges(const float* error, float metres_per_unit, std::size_t count, std::uint16_t* units) {
  for (std::size_t i = 0; i < count; ++i) {
    const float range = units[i];
    // A range at infinity or beyond would divide by zero; it comes out saturated and is dropped.
    const float share = std::max(1 + range * metres_per_unit * error[i], range * (1 / kSaturatedUnits));
    const int corrected = static_cast<int>(range / share + 0.5F);
    const int kept = corrected < 65535 ? corrected : 0;
    units[i] = static_cast<std::uint16_t>(units[i] == 65535 ? 65535 : kept);
  }
}

}  // namespace

// Properties of an image that its table depends on, beside the coefficients.
struct DepthDistortion::ImageKey {
  int width, height;
  bool is_depth;
  std::array<double, 4> camera;  // zeros for depths, whose table does not depend on it

  explicit ImageKey(const CObservation3DRangeScan& scan)
      : width(static_cast<int>(scan.rangeImage.cols())),
        height(static_cast<int>(scan.rangeImage.rows())),
        is_depth(scan.range_is_depth),
        camera{} {
    const auto& c = scan.cameraParams;
    if (!is_depth) camera = {c.fx(), c.fy(), c.cx(), c.cy()};
  }
  bool operator==(const ImageKey& other) const {
    return width == other.width && height == other.height && is_depth == other.is_depth && camera == other.camera;
  }
  // Range over depth along the ray through a pixel.
  double rangeOverDepth(int u, int v) const {
    return is_depth ? 1 : std::hypot(1, (u - camera[2]) / camera[0], (v - camera[3]) / camera[1]);
  }
};

struct DepthDistortion::Table {
  ImageKey key;
  std::vector<float> error;  // [1/m] of the inverse range of each pixel
};

std::size_t DepthDistortion::termsOf(int degree) {
  return static_cast<std::size_t>((degree + 1) * (degree + 2) / 2 - 3);
}

void DepthDistortion::evaluate(int degree, double x, double y, double* values) {
  const auto across = legendreUpTo(degree, x), down = legendreUpTo(degree, y);
  for (int total = kLeastDegree; total <= degree; ++total)
    for (int j = 0; j <= total; ++j)
      *values++ = across[static_cast<std::size_t>(total - j)] * down[static_cast<std::size_t>(j)];
}

DepthDistortion::DepthDistortion(std::vector<double> coefficients) : coefficients_(std::move(coefficients)) {
  if (coefficients_.empty()) return;
  std::string counts;
  for (int degree = kLeastDegree; degree <= kMostDegree; ++degree) {
    if (termsOf(degree) == coefficients_.size()) degree_ = degree;
    counts += (degree == kLeastDegree ? "" : degree == kMostDegree ? " or " : ", ") + std::to_string(termsOf(degree));
  }
  if (degree_ == 0)
    throw base::Error(base::ExitCode::out_of_range, "a depth distortion has " + counts + " coefficients, not " +
                                                        std::to_string(coefficients_.size()));
  if (!std::all_of(coefficients_.begin(), coefficients_.end(), [](double c) { return std::isfinite(c); }))
    throw base::Error(base::ExitCode::out_of_range, "a depth distortion has a coefficient that is not finite");
}

double DepthDistortion::at(double x, double y) const {
  if (isNone()) return 0;
  std::array<double, (kMostDegree + 1) * (kMostDegree + 2) / 2> values{};
  evaluate(degree_, x, y, values.data());
  double sum = 0;
  for (std::size_t i = 0; i < coefficients_.size(); ++i) sum += coefficients_[i] * values[i];
  return sum;
}

std::shared_ptr<const DepthDistortion::Table> DepthDistortion::tableOf(const CObservation3DRangeScan& scan) const {
  const ImageKey key(scan);
  const auto kept = std::atomic_load(&table_);
  if (kept && kept->key == key) return kept;
  auto table = std::make_shared<Table>(Table{key, {}});
  table->error.reserve(static_cast<std::size_t>(scan.rangeImage.size()));
  for (int v = 0; v < key.height; ++v) {
    for (int u = 0; u < key.width; ++u) {
      const double error = at(normalized(u, key.width), normalized(v, key.height)) / key.rangeOverDepth(u, v);
      // A camera without a calibration has no rays; its ranges stay as they are.
      table->error.push_back(std::isfinite(error) ? static_cast<float>(error) : 0.F);
    }
  }
  const std::shared_ptr<const Table> made = std::move(table);
  std::atomic_store(&table_, made);
  return made;
}

void DepthDistortion::applyTo(CObservation3DRangeScan& scan) const {
  if (isNone() || !scan.hasRangeImage || scan.rangeImage.size() == 0) return;
  const auto table = tableOf(scan);
  correctRanges(table->error.data(), scan.rangeUnits, table->error.size(), scan.rangeImage.data());
  if (!scan.hasPoints3D) return;
  scan.hasPoints3D = false;
  scan.resizePoints3DVectors(0);
}

}  // namespace omnimapper::camera
