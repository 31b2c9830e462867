#include <omnimapper/base/Error.h>
#include <omnimapper/query/MapGrid.h>

#include <filesystem>
#include <system_error>

namespace omnimapper::query {

namespace fs = std::filesystem;

GridMap readGrid(const std::string& folder) {
  const std::string file = (fs::path(folder) / "grid.yaml").string();
  const std::string remedy = " Map the log again with a GridOutput in [mapper] output_plugins.";
  const auto refuse = [&](const std::string& message) {
    throw base::Error(base::ExitCode::unreadable_input, message + remedy);
  };
  std::error_code none;
  if (!fs::exists(file, none))
    refuse(file +
           ": is missing, and without the map's occupancy grid the free space is not known. A grid needs a log with a "
           "laser.");
  GridMap grid;
  try {
    grid = omnimapper::grid::readGridMap(file);
  } catch (const base::Error& error) {
    if (error.code() != base::ExitCode::unreadable_input) throw;
    refuse(error.what());
  }
  if (grid.map_from_grid.yaw != 0) refuse(file + ": has an \"origin\" with a yaw: rotated grids are not supported.");
  return grid;
}

}  // namespace omnimapper::query
