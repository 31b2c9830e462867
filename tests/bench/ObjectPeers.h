#pragma once

#include <omnimapper/camera/DepthImage.h>

#include <functional>
#include <string>
#include <vector>

#include "pcd_folder/PcdCloud.h"

namespace omnimapper::bench {

/// The pixels of each object that was found.
using Objects = std::vector<std::vector<int>>;

/// An organized cloud in a camera's optical frame. Labels from 20 on are those of objects.
struct LabelledCloud {
  source::PcdCloud points;
  camera::Pinhole camera;
  std::string name;
};

/// A method that finds objects in an organized cloud. The whole call of `run` is timed.
struct ObjectPeer {
  std::string name;
  std::function<Objects(const LabelledCloud&)> run;
};

/// PCL's chain for organized clouds, and supervoxels. Both are empty if bench-objects was built without PCL.
std::vector<ObjectPeer> pclObjects();
std::vector<ObjectPeer> lccpObjects();

}  // namespace omnimapper::bench
