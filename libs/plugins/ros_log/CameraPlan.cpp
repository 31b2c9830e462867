#include "CameraPlan.h"

namespace omnimapper::ros {

namespace {

// "/camera/color" of "/camera/color/image_raw".
std::string parentOf(const std::string& topic) {
  const auto slash = topic.rfind('/');
  return slash == std::string::npos ? "" : topic.substr(0, slash);
}

// "camera" of "/camera/color/image_raw".
std::string firstPart(const std::string& topic) {
  const auto begin = topic.find_first_not_of('/');
  return begin == std::string::npos ? "" : topic.substr(begin, topic.find('/', begin) - begin);
}

// The CameraInfo beside the images or above them, as image/compressed has; else one of the same frame.
const CalibratedCamera* cameraFor(const SensorKey& images, const Survey& survey) {
  for (std::string folder = parentOf(images.first); !folder.empty(); folder = parentOf(folder)) {
    const auto beside = survey.cameras.find(folder + "/camera_info");
    if (beside != survey.cameras.end()) return &beside->second;
  }
  if (const auto root = survey.cameras.find("camera_info"); root != survey.cameras.end()) return &root->second;
  for (const auto& topic_and_camera : survey.cameras)
    if (!images.second.empty() && topic_and_camera.second.frame == images.second) return &topic_and_camera.second;
  return nullptr;
}

}  // namespace

CameraPlan::CameraPlan(const Survey& survey) {
  for (const auto& [sensor, seen] : survey.sensors)
    if (seen.role == Role::image) uses_[sensor.first] = useOf(sensor, seen, survey);
  for (auto& topic_and_use : uses_) {
    CameraUse& use = topic_and_use.second;
    if (!use.is_depth || !use.problem.empty()) continue;
    use.picture = pictureOfDepths(topic_and_use.first, survey);
    if (!use.picture.empty()) uses_[use.picture].is_part_of_depth = true;
  }
}

CameraUse CameraPlan::useOf(const SensorKey& sensor, const SeenSensor& seen, const Survey& survey) const {
  CameraUse use;
  use.is_depth = seen.content == ImageContent::depths;
  use.frame = sensor.second;
  const CalibratedCamera* camera = cameraFor(sensor, survey);
  if (seen.content == ImageContent::deep_grey) {
    use.problem = "grey values of 16 bits (mono16), which are depths only on a topic with 'depth' in its name";
  } else if (!camera) {
    use.problem = "no CameraInfo of their camera";
  } else if (!camera->problem.empty()) {
    use.problem = "the CameraInfo of their camera " + camera->problem;
  } else {
    const bool is_rectified = sensor.first.find("rect") != std::string::npos;
    use.camera = is_rectified ? camera->rectified : camera->raw;
  }
  return use;
}

std::string CameraPlan::pictureOfDepths(const std::string& depths, const Survey& survey) const {
  const CameraUse& depth = uses_.at(depths);
  std::string best;
  for (const auto& [topic, use] : uses_) {
    if (use.is_depth || !use.problem.empty()) continue;
    if (use.frame == depth.frame) return topic;
    const bool is_near = firstPart(topic) == firstPart(depths) && survey.transforms.connects(use.frame, depth.frame);
    if (is_near && best.empty()) best = topic;
  }
  return best;
}

const CameraUse* CameraPlan::use(const std::string& topic) const {
  const auto found = uses_.find(topic);
  return found == uses_.end() ? nullptr : &found->second;
}

}  // namespace omnimapper::ros
