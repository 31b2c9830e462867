#pragma once

#include <omnimapper/sim/Pinhole.h>
#include <omnimapper/sim_world/Scene.h>

#include <array>
#include <vector>

namespace omnimapper::sim {

/// From where a picture is taken, and when.
struct CameraView {
  Pinhole camera;
  geometry::Se3 map_from_optical;
  double time = 0;  ///< [s]
};

/// What a picture shows of a flat rectangle, a sign or a marker.
struct FaceView {
  /// As the reader sees them: upper left, upper right, lower right, lower left; they may lie beside the picture
  /// [pixel].
  std::array<Eigen::Vector2d, 4> corners;
  double distance = 0;    ///< from the camera to its middle [m]
  double incidence = 0;   ///< between its normal and the ray to its middle, 0: seen from straight in front [rad]
  double visible = 0;     ///< part of it that is in the picture and not hidden, by 25 rays; above 0
  bool is_whole = false;  ///< all corners are in the picture
};

/// What a picture shows of a door sign.
struct SignView : FaceView {
  int sign = 0;               ///< in World::signs
  double capitals = 0;        ///< height of a capital of its first line in the picture [pixel]
  double least_capitals = 0;  ///< the same of the line with the smallest [pixel]
};

/// All signs of which the picture shows something, in the order of World::signs. `scene` is the world at view.time.
/// What lies behind glass is seen.
std::vector<SignView> signsInView(const World& world, const Scenes& scenes, const Scene& scene, const CameraView& view);

/// From what on a sign counts as legible: for a number networks need capitals of about 16 pixels.
struct Legibility {
  double capitals = 16;                           ///< of the first line, at least [pixel]
  double incidence = 3.14159265358979323846 / 3;  ///< at most [rad]
  double visible = 0.9;                           ///< at least
};
/// Whether it is large, straight, whole and free enough to be read.
bool isLegible(const SignView& view, const Legibility& legibility = {});

/// How often a sign can be read.
struct SignReadings {
  int pictures = 0;  ///< in which it is legible
  int visits = 0;    ///< pictures more than half a minute apart are of different visits
};

/// Counts over the pictures of a run, camera by camera or mixed.
class SignCounter {
 public:
  explicit SignCounter(std::size_t signs) : readings_(signs), last_(signs) {}

  /// Pictures come in the order of their time [s], give or take some seconds.
  void add(double time, const std::vector<SignView>& signs);
  /// One for each of World::signs.
  const std::vector<SignReadings>& readings() const { return readings_; }
  /// In how many pictures signs are legible, those of all signs added up.
  int pictures() const;
  /// How many signs are legible in so many pictures.
  int inPictures(int at_least) const;
  /// How many signs are legible on so many visits.
  int onVisits(int at_least) const;

 private:
  std::vector<SignReadings> readings_;
  std::vector<double> last_;  // when it was legible [s]
};

}  // namespace omnimapper::sim
