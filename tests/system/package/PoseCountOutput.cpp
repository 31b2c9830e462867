// A plugin that is built outside the project. It writes the number of key frames of the map.
#include <omnimapper/base/AtLoad.h>
#include <omnimapper/plugin/PluginFactory.h>

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
  explicit PoseCountOutput(const std::string& path) : path_(path) {}
  void finish(const mapper::View& view) override { std::ofstream(path_) << view.map.key_frames.size() << "\n"; }

 private:
  std::string path_;
};

class PoseCountOutputFactory : public mapper::OutputPluginFactory {
  DEFINE_MRPT_OBJECT(PoseCountOutputFactory, foreign)
 public:
  std::string name() const override { return "PoseCountOutput"; }
  std::string summary() const override { return "Writes the number of key frames."; }
  const std::vector<base::OptionSpec>& options() const override { return PoseCountOptions::table().specs(); }
  std::unique_ptr<mapper::OutputPlugin> make(const base::ConfigSection& section,
                                             const mapper::PluginContext& context) const override {
    const auto options = section.read<PoseCountOptions>(mapper::sectionKeysOfEngine());
    return std::make_unique<PoseCountOutput>(context.output_folder + "/" + options.file);
  }
};

}  // namespace foreign

IMPLEMENTS_MRPT_OBJECT(PoseCountOutputFactory, omnimapper::mapper::OutputPluginFactory, foreign)

const omnimapper::base::AtLoad kRegister([] { mrpt::rtti::registerClass(CLASS_ID(foreign::PoseCountOutputFactory)); });
