#include <omnimapper/derived/GridMapper.h>
#include <omnimapper/derived/ScanGrid.h>

#include <sstream>

namespace omnimapper::derived {

std::optional<ScanGrid> buildScanGrid(const map::Map& map, const ScanGridOptions& options) {
  GridMapper mapper(options);
  mapper.update(map);
  return mapper.scanGrid();
}

std::shared_ptr<const std::optional<ScanGrid>> scanGridOf(const mapper::View& view, const ScanGridOptions& options) {
  const auto build = [&] { return buildScanGrid(view.map, options); };
  if (!view.shared) return std::make_shared<const std::optional<ScanGrid>>(build());
  std::ostringstream key;
  key.precision(17);
  key << options.resolution << ' ' << options.max_range << ' ' << options.margin << ' ' << options.max_cells;
  return view.shared->get<std::optional<ScanGrid>>(key.str(), build);
}

}  // namespace omnimapper::derived
