#include "ScanGrid.h"

#include "GridMapper.h"

namespace omnimapper::plugins {

std::optional<ScanGrid> buildScanGrid(const map::Map& map, const ScanGridOptions& options) {
  GridMapper mapper(options);
  mapper.update(map);
  return mapper.scanGrid();
}

}  // namespace omnimapper::plugins
