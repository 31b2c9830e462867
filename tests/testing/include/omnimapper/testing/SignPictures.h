#pragma once

#include <mrpt/img/CImage.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace omnimapper::testing {

/// A door sign that is at least partly in a picture.
struct PicturedSign {
  std::string name;                           ///< name of the sign, the same in all pictures of its place
  std::string text;                           ///< its lines, separated by '|'
  std::array<Eigen::Vector2f, 4> corners_px;  ///< upper left, upper right, lower right, lower left, as it is read
  double visible = 0;                         ///< share of the sign that is in the picture and not hidden
};

struct SignPicture {
  std::string name;  ///< file name without extension, unique for style and seed
  mrpt::img::CImage image;
  std::vector<PicturedSign> signs;
};

/// Options of the pictures.
struct SignPictureOptions {
  std::string style = "dark";  ///< "dark": an office with dark blue signs; "white": halls with white ones
  std::uint64_t seed = 1;
  int places = 4;                  ///< number of buildings of the style, each with other rooms, walls and texts
  int width = 1280, height = 960;  ///< [px]
};

/// Pictures of the simulator's buildings of one style, each with another position, direction and lighting. They show
/// signs beside doors, other objects on walls and doors (posters, notices, clocks, plates above fire extinguishers,
/// switches, sockets, thermostats, grilles, door handles), or rooms. The same options give the same pictures.
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
