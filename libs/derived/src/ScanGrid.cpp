#include <omnimapper/derived/GridMapper.h>
#include <omnimapper/derived/ScanGrid.h>

namespace omnimapper::derived {

std::optional<ScanGrid> buildScanGrid(const map::Map& map, const ScanGridOptions& options) {
  GridMapper mapper(options);
  mapper.update(map);
  return mapper.scanGrid();
}

}  // namespace omnimapper::derived
