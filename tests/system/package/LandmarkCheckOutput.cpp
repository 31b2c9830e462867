// An output plugin made outside the project that compares the landmarks of the map with a file of true positions. The
// landmarks are those of a measurement plugin that is not part of the project either.
#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/PluginFactory.h>

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
  LandmarkCheckOutput(const std::string& path, const std::string& truth) : path_(path), truth_(truth) {}

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

class LandmarkCheckOutputFactory : public mapper::OutputPluginFactory {
  DEFINE_MRPT_OBJECT(LandmarkCheckOutputFactory, foreign)
 public:
  std::string name() const override { return "LandmarkCheckOutput"; }
  std::string summary() const override { return "Compares landmarks with true positions."; }
  const std::vector<base::OptionSpec>& options() const override { return LandmarkCheckOptions::table().specs(); }
  std::unique_ptr<mapper::OutputPlugin> make(const base::ConfigSection& section,
                                             const mapper::PluginContext& context) const override {
    const auto options = section.read<LandmarkCheckOptions>(mapper::sectionKeysOfEngine());
    return std::make_unique<LandmarkCheckOutput>(context.output_folder + "/" + options.file, options.truth);
  }
};

}  // namespace foreign

IMPLEMENTS_MRPT_OBJECT(LandmarkCheckOutputFactory, omnimapper::mapper::OutputPluginFactory, foreign)

const omnimapper::base::AtLoad kRegister([] {
  mrpt::rtti::registerClass(CLASS_ID(foreign::LandmarkCheckOutputFactory));
});
