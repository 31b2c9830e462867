#include "ObjectsInFrame.h"

#include <algorithm>
#include <map>
#include <string>

namespace omnimapper::sim {

namespace {

void addPixel(int column, int row, double distance, bool has_depth, ObjectView& view) {
  if (view.pixels == 0) {
    view.left = view.right = column;
    view.top = row;
  }
  view.left = std::min(view.left, column);
  view.right = std::max(view.right, column);
  view.bottom = row;  // rows come in order
  ++view.pixels;
  view.with_depth += has_depth ? 1 : 0;
  view.distance += (distance - view.distance) / view.pixels;
}

}  // namespace

ObjectsInFrame::ObjectsInFrame(const World& world) : objects_(world.objects.size()) {
  std::map<std::string, int> numbers;
  for (std::size_t i = 0; i < world.objects.size(); ++i) numbers[world.objects[i].name] = static_cast<int>(i);
  for (const SurfaceRef& surface : numberSurfaces(world)) {
    const auto found = numbers.find(world.bodies[static_cast<std::size_t>(surface.body)].name);
    object_of_surface_.push_back(found == numbers.end() ? -1 : found->second);
  }
}

std::vector<ObjectView> ObjectsInFrame::find(const Frame& frame,
                                             const std::function<bool(int column, int row)>& hasDepth) const {
  if (objects_ == 0) return {};
  std::vector<ObjectView> views(objects_);
  for (int row = 0; row < frame.camera.height; ++row) {
    for (int column = 0; column < frame.camera.width; ++column) {
      const PixelHit& hit = frame.at(column, row);
      const int object = hit.surface < 0 ? -1 : object_of_surface_[static_cast<std::size_t>(hit.surface)];
      if (object < 0) continue;
      addPixel(column, row, hit.depth * frame.camera.through(column, row).norm(), hasDepth(column, row),
               views[static_cast<std::size_t>(object)]);
    }
  }
  for (std::size_t i = 0; i < objects_; ++i) views[i].object = static_cast<int>(i);
  views.erase(std::remove_if(views.begin(), views.end(), [](const ObjectView& view) { return view.pixels == 0; }),
              views.end());
  return views;
}

}  // namespace omnimapper::sim
