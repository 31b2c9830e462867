#include "RoomsOutput.h"

#include <omnimapper/base/AtLoad.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/OutputFile.h>

#include "Rooms.h"

namespace base = omnimapper::base;
namespace derived = omnimapper::derived;
namespace mapper = omnimapper::mapper;

IMPLEMENTS_MRPT_OBJECT(RoomsOutputFactory, omnimapper::mapper::OutputPluginFactory, rooms_layer)

namespace rooms_layer {

const base::OptionTable<RoomsOutputOptions>& RoomsOutputOptions::table() {
  static const auto table = base::OptionTable<RoomsOutputOptions>().text("file", &RoomsOutputOptions::file,
                                                                         "Name of the file in the output folder.");
  return table;
}

void RoomsOutput::finish(const mapper::View& view) {
  std::string text = "stamp,x_m,y_m,z_m,name\n";
  if (const auto* layer = view.map.layers.find<Rooms>()) {
    for (const auto& [name, room] : layer->rooms) {
      text += base::formatUnix(room.read_at);
      for (const double metres : room.inMap(view.map)) text += "," + base::fixed(metres, 3);
      text += "," + base::printable(name) + "\n";  // the last column, because it may have commas
    }
  }
  derived::writeBytes(path_, text);
}

std::unique_ptr<mapper::OutputPlugin> RoomsOutputFactory::make(const base::ConfigSection& section,
                                                               const mapper::PluginContext& context) const {
  const auto options = section.read<RoomsOutputOptions>(mapper::sectionKeysOfEngine());
  return std::make_unique<RoomsOutput>(derived::outputPath(context, options.file));
}

const base::AtLoad kRegisterRoomsOutput([] { mrpt::rtti::registerClass(CLASS_ID(RoomsOutputFactory)); });

}  // namespace rooms_layer
