#pragma once

#include <omnimapper/sim/Pinhole.h>
#include <omnimapper/sim_world/Scene.h>

#include <array>
#include <vector>

namespace omnimapper::sim {

/// Camera, pose and time of a picture.
struct CameraView {
  Pinhole camera;
  geometry::Se3 map_from_optical;
  double time = 0;  ///< [s]
};

/// A flat rectangle, a sign or a marker, as it appears in a picture.
struct FaceView {
  /// Corners as the reader sees them: upper left, upper right, lower right, lower left; they may lie outside the
  /// picture [pixel].
  std::array<Eigen::Vector2d, 4> corners;
  double distance = 0;    ///< from the camera to the middle of the rectangle [m]
  double incidence = 0;   ///< angle between the normal and the ray to the middle [rad]; 0: seen from straight in front
  double visible = 0;     ///< part of the rectangle that is in the picture and not hidden, measured by 25 rays; above 0
  bool is_whole = false;  ///< all corners are in the picture
};

/// A door sign as it appears in a picture.
struct SignView : FaceView {
  int sign = 0;               ///< index in World::signs
  double capitals = 0;        ///< height of a capital of its first line in the picture [pixel]
  double least_capitals = 0;  ///< the same for the line with the smallest capitals [pixel]
};

/// All signs that are at least partly visible in the picture, in the order of World::signs. `scene` is the world at
/// view.time. Signs behind glass are visible.
std::vector<SignView> signsInView(const World& world, const Scenes& scenes, const Scene& scene, const CameraView& view);

/// Limits within which a sign counts as legible. To read a number, networks need capitals of about 16 pixels.
struct Legibility {
  double capitals = 16;                           ///< of the first line, at least [pixel]
  double incidence = 3.14159265358979323846 / 3;  ///< at most [rad]
  double visible = 0.9;                           ///< at least
};
/// Whether a sign is whole, large enough, not too slanted and not too hidden to be read.
bool isLegible(const SignView& view, const Legibility& legibility = {});

/// How often a sign can be read.
struct SignReadings {
  int pictures = 0;  ///< number of pictures in which the sign is legible
  int visits = 0;    ///< number of visits with such a picture; pictures more than 30 s apart are of different visits
};

/// Counts legible signs over the pictures of a run.
class SignCounter {
 public:
  explicit SignCounter(std::size_t signs) : readings_(signs), last_(signs) {}

  /// Adds a picture. Times [s] may go back by a few seconds, as between the pictures of several cameras.
  void add(double time, const std::vector<SignView>& signs);
  /// One for each of World::signs.
  const std::vector<SignReadings>& readings() const { return readings_; }
  /// Number of pictures in which a sign is legible, summed over all signs.
  int pictures() const;
  /// Number of signs that are legible in at least that many pictures.
  int inPictures(int at_least) const;
  /// Number of signs that are legible on at least that many visits.
  int onVisits(int at_least) const;

 private:
  std::vector<SignReadings> readings_;
  std::vector<double> last_;  // time at which each sign was last legible [s]
};

}  // namespace omnimapper::sim
