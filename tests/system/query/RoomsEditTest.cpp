// omnimapper-rooms MAP edit: the files of a map and its layer change together, or not at all.
#include <omnimapper/building/RoomsFile.h>
#include <omnimapper/building/Segmentation.h>
#include <omnimapper/map/MapFile.h>

#include "../Runs.h"

namespace rooms_edit_test {
namespace {

using namespace runs;
namespace building = omnimapper::building;
using omnimapper::map::MapFile;

/// The folder of a map of one room, 4 m x 3 m.
class RoomsEdit : public ::testing::Test {
 protected:
  RoomsEdit() {
    const int columns = 84, rows = 64;
    std::ofstream pgm(folder_ / "grid.pgm", std::ios::binary);
    pgm << "P5\n" << columns << " " << rows << "\n255\n";
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        pgm << (row < 2 || column < 2 || row >= rows - 2 || column >= columns - 2 ? '\0' : '\xfe');
    pgm.close();
    std::ofstream(folder_ / "grid.yaml") << "image: grid.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n"
                                            "occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    const auto storey = building::segmentRooms(omnimapper::grid::readGridMap(folder_ / "grid.yaml")).storey;
    const std::string rooms = building::encodeRooms({{storey}});
    std::ofstream(folder_ / "rooms.json") << rooms;
    MapFile map;
    map.set({building::kRoomsLayer, building::kRoomsLayerVersion, rooms});
    map.write(folder_ / "map.omnimap");
  }
  static Ended edit(const std::string& map, const Texts& words) {
    Texts command{omnimapper::testing::ownProgram("omnimapper-rooms"), map, "edit"};
    command.insert(command.end(), words.begin(), words.end());
    return omnimapper::testing::runProgram(command);
  }
  std::string layer() const { return MapFile::read(folder_ / "map.omnimap").find(building::kRoomsLayer)->bytes; }

  omnimapper::testing::ScratchFolder folder_;
};

TEST_F(RoomsEdit, ChangesTheLayerAlsoIfTheYamlFileIsNamed) {
  for (const auto& map : {folder_.path(), folder_ / "grid.yaml"}) {
    const std::string name = map == folder_.path() ? "kitchen" : "library";
    ASSERT_TRUE(endedWith(ExitCode::ok, edit(map, {"rename", "1", name})));
    EXPECT_EQ(layer(), readFile(folder_ / "rooms.json"));
    EXPECT_NE(layer().find(name), std::string::npos);
  }
}

TEST_F(RoomsEdit, ChangesNothingIfTheMapCannotBeRead) {
  std::ofstream(folder_ / "map.omnimap") << "no map";
  const std::string before = readFile(folder_ / "rooms.json");
  EXPECT_TRUE(endedWith(ExitCode::unreadable_input, edit(folder_.path(), {"rename", "1", "kitchen"}), {"map.omnimap"}));
  EXPECT_EQ(readFile(folder_ / "rooms.json"), before);
  EXPECT_FALSE(fs::exists(folder_ / "edits.json"));
}

}  // namespace
}  // namespace rooms_edit_test
