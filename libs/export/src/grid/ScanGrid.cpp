#include "grid/ScanGrid.h"

#include "grid/GridMapper.h"

namespace omnimapper::exports {

std::optional<ScanGrid> buildScanGrid(const map::Map& map, const ScanGridOptions& options) {
  GridMapper mapper(options);
  mapper.update(map);
  return mapper.scanGrid();
}

}  // namespace omnimapper::exports
