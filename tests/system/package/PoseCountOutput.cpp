// A plugin that is built outside the project. It writes the number of key frames of the map.
#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/FactoryOf.h>

#include <fstream>

namespace foreign {

using namespace omnimapper;

struct PoseCountOptions {
  std::string file = "poses.txt";

  static const base::OptionTable<PoseCountOptions>& table() {
    static const auto table = base::OptionTable<PoseCountOptions>().text("file", &PoseCountOptions::file,
                                                                         "Name of the file in the output folder.");
    return table;
  }
};

class PoseCountOutput : public mapper::OutputPlugin {
 public:
  static constexpr const char* kName = "PoseCountOutput";
  static constexpr const char* kSummary = "Writes the number of key frames.";

  PoseCountOutput(const PoseCountOptions& options, const mapper::PluginContext& context)
      : path_(context.output_folder + "/" + options.file) {}
  void finish(const mapper::View& view) override { std::ofstream(path_) << view.map.key_frames.size() << "\n"; }

 private:
  std::string path_;
};

}  // namespace foreign

const omnimapper::base::AtLoad kRegister([] {
  omnimapper::mapper::FactoryOf<foreign::PoseCountOutput, foreign::PoseCountOptions>::registerClass();
});
