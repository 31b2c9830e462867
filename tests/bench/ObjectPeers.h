#pragma once

#include <omnimapper/perception/DepthImage.h>
#include <omnimapper/source/PcdCloud.h>

#include <functional>
#include <string>
#include <vector>

namespace omnimapper::bench {

/// The pixels of each thing that was found.
using Things = std::vector<std::vector<int>>;

/// An organised cloud in a camera's optical frame; labels from 20 on are of things.
struct LabelledCloud {
  source::PcdCloud points;
  perception::Pinhole camera;
};

/// Somebody's way from an organised cloud to the things in it. What is called is what is timed.
struct ObjectPeer {
  std::string name;
  std::function<Things(const LabelledCloud&)> run;
};

/// None where bench-objects was built without PCL: its organised chain, and supervoxels.
std::vector<ObjectPeer> pclObjects();
std::vector<ObjectPeer> lccpObjects();

}  // namespace omnimapper::bench
