#pragma once

#include <mrpt/img/CImage.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::testing {

/// A door sign that a picture shows something of.
struct PicturedSign {
  std::string name;                           ///< of the sign, the same in every picture of its place
  std::string text;                           ///< its lines, separated by '|'
  std::array<Eigen::Vector2f, 4> corners_px;  ///< upper left, upper right, lower right, lower left as it is read
  double visible = 0;                         ///< part of it that is in the picture and not hidden
};

struct SignPicture {
  std::string name;  ///< without ending, unique for style and seed
  mrpt::img::CImage image;
  std::vector<PicturedSign> signs;
};

/// Which pictures.
struct SignPictureOptions {
  std::string style = "dark";  ///< "dark": an office with dark blue signs; "white": halls with white ones
  std::uint64_t seed = 1;
  int places = 4;                  ///< buildings of the style, each with other rooms, walls and texts
  int width = 1280, height = 960;  ///< [px]
};

/// Pictures of the simulator's buildings of one style, each from a place, in a direction and with a light of its own:
/// of signs beside doors, of what hangs on walls without being a sign (posters, notices, clocks, plates above fire
/// extinguishers, switches, sockets, thermostats, grilles, handles of doors) and of rooms. The same options give the
/// same pictures.
class SignPictures {
 public:
  explicit SignPictures(const SignPictureOptions& options);
  ~SignPictures();

  /// Picture k, 0 or greater; thread-safe.
  SignPicture picture(int k) const;

 private:
  class Place;
  SignPictureOptions options_;
  std::vector<std::unique_ptr<Place>> places_;
};

}  // namespace omnimapper::testing
