#include "RoomsOutput.h"

#include <omnimapper/base/AtLoad.h>
#include <omnimapper/base/Names.h>
#include <omnimapper/base/Numbers.h>
#include <omnimapper/derived/OutputFile.h>
#include <omnimapper/plugin/FactoryOf.h>

#include "Rooms.h"

namespace base = omnimapper::base;
namespace derived = omnimapper::derived;
namespace mapper = omnimapper::mapper;

namespace rooms_layer {

const base::OptionTable<RoomsOutputOptions>& RoomsOutputOptions::table() {
  static const auto table = base::OptionTable<RoomsOutputOptions>().text("file", &RoomsOutputOptions::file,
                                                                         "Name of the file in the output folder.");
  return table;
}

RoomsOutput::RoomsOutput(const RoomsOutputOptions& options, const mapper::PluginContext& context)
    : path_(derived::outputPath(context, options.file)) {}

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

const base::AtLoad kRegisterRoomsOutput([] { mapper::FactoryOf<RoomsOutput, RoomsOutputOptions>::registerClass(); });

}  // namespace rooms_layer
