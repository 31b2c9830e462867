#pragma once

#include <omnimapper/geometry/Polygon3.h>
#include <omnimapper/obs/Rgb.h>

#include <Eigen/Core>
#include <optional>
#include <string>

namespace omnimapper::obs {

/// A row of fields separated by blanks, for files that a program reads again (see CDerivedObservation).
class TextRow {
 public:
  TextRow& number(double value);
  TextRow& whole(long long value);
  TextRow& text(const std::string& value);
  template <int size>
  TextRow& vector(const Eigen::Matrix<double, size, 1>& values) {
    for (int i = 0; i < size; ++i) number(values[i]);
    return *this;
  }
  /// The entries on and above the diagonal.
  template <int size>
  TextRow& symmetric(const Eigen::Matrix<double, size, size>& values) {
    for (int i = 0; i < size; ++i)
      for (int j = i; j < size; ++j) number(values(i, j));
    return *this;
  }
  TextRow& colour(const std::optional<Rgb>& value);
  TextRow& polygon(const geometry::Polygon3& value);

  const std::string& str() const { return row_; }

 private:
  TextRow& field(const std::string& value);
  std::string row_;
};

/// A number in few digits, for people to read.
std::string shortly(double value);

/// UTF-8 text with all other characters than ASCII written as \u00fc and the like, and bytes that are no UTF-8 as \xfc.
/// Windows of stock tools show nothing of a text with a character that their locale does not have.
std::string inAscii(const std::string& text);

}  // namespace omnimapper::obs
