// An output plugin made outside the project that compares the landmarks of the map with a file of true positions. The
// landmarks are those of a measurement plugin that is not part of the project either.
#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace foreign {

using namespace omnimapper;

struct LandmarkCheckOptions {
  std::string file = "landmarks.txt";
  std::string truth;

  static const base::OptionTable<LandmarkCheckOptions>& table() {
    using Options = LandmarkCheckOptions;
    static const auto table =
        base::OptionTable<Options>()
            .text("file", &Options::file, "Name of the file in the output folder.")
            .text("truth", &Options::truth, "File of true positions, 'x y z' at the beginning of each line.");
    return table;
  }
};

// Of the active landmarks, writes "<landmarks> <true positions> <worst distance of a true position from the nearest
// landmark [mm]>".
class LandmarkCheckOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "LandmarkCheckOutput";
  static constexpr const char* kSummary = "Compares landmarks with true positions.";

  LandmarkCheckOutput(const LandmarkCheckOptions& options, const mapper::PluginContext& context)
      : path_(context.output_folder + "/" + options.file), truth_(options.truth) {}

  void finish(const mapper::View& view) override {
    std::vector<Eigen::Vector3d> middles;
    for (const auto& [id, landmark] : view.map.landmarks) {
      if (landmark.state != map::Landmark::State::active) continue;
      middles.push_back(view.graph.value(landmark.variables.front()).head<3>());
    }
    std::ifstream truth(truth_);
    Eigen::Vector3d position;
    double worst = 0;
    int positions = 0;
    for (std::string rest; truth >> position.x() >> position.y() >> position.z(); ++positions) {
      std::getline(truth, rest);
      double nearest = std::numeric_limits<double>::infinity();
      for (const auto& middle : middles) nearest = std::min(nearest, (middle - position).norm());
      worst = std::max(worst, std::min(nearest, 1e6));
    }
    std::ofstream(path_) << middles.size() << " " << positions << " " << std::lround(1000 * worst) << "\n";
  }

 private:
  std::string path_, truth_;
};

}  // namespace foreign

const omnimapper::base::AtLoad kRegisterLandmarkCheck([] {
  omnimapper::mapper::FactoryOf<foreign::LandmarkCheckOutput, foreign::LandmarkCheckOptions>::registerClass();
});
