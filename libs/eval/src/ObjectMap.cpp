#include <omnimapper/base/Error.h>
#include <omnimapper/base/InputFile.h>
#include <omnimapper/eval/ObjectMap.h>
#include <omnimapper/eval/TriangleMesh.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace omnimapper::eval {

namespace {

MappedObject::State stateFrom(const std::string& name) {
  if (name == "present") return MappedObject::State::present;
  if (name == "gone") return MappedObject::State::gone;
  if (name == "candidate") return MappedObject::State::candidate;
  throw std::invalid_argument("the state '" + name + "' is none of present, gone and candidate");
}

Eigen::VectorXd numbersFrom(const nlohmann::json& list, int count) {
  if (!list.is_array() || static_cast<int>(list.size()) != count)
    throw std::invalid_argument("a list has not " + std::to_string(count) + " numbers");
  Eigen::VectorXd numbers(count);
  for (int i = 0; i < count; ++i) numbers[i] = list.at(static_cast<std::size_t>(i)).get<double>();
  if (!numbers.allFinite()) throw std::invalid_argument("a number is not finite");
  return numbers;
}

MappedObject objectFrom(const nlohmann::json& entry, const std::string& folder) {
  MappedObject object;
  object.id = entry.at("id").get<std::string>();
  object.state = stateFrom(entry.at("state").get<std::string>());
  const nlohmann::json& box = entry.at("box");
  object.map_from_box.translation = numbersFrom(box.at("middle"), 3);
  const Eigen::Vector4d q = numbersFrom(box.at("map_from_box"), 4);
  if (std::abs(q.norm() - 1) > 0.01) throw std::invalid_argument("map_from_box is no unit quaternion");
  object.map_from_box.rotation = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
  object.box_size = numbersFrom(box.at("size"), 3);
  object.seen_in = entry.at("seen_in").get<int>();
  if (object.seen_in < 0) throw std::invalid_argument("seen_in is negative");
  if (const nlohmann::json& looked = entry.at("last_looked"); !looked.is_null())
    object.last_looked = looked.get<double>();
  const std::filesystem::path model = entry.at("model").get<std::string>();
  if (model.is_absolute() || std::count(model.begin(), model.end(), "..") > 0)
    throw std::invalid_argument("the model is not in the folder");
  object.points = readTriangleMesh((folder / model).string()).vertices;
  return object;
}

}  // namespace

ObjectMap readObjectMap(const std::string& folder) {
  const std::string path = folder + "/objects.json";
  const auto refuse = [&](const std::string& place, const std::string& why) {
    throw base::Error(base::ExitCode::unreadable_input,
                      path + ": " + place + why + "; map the log again with a plugin that writes objects.json");
  };
  const std::string text = base::readInput(path, "list of a map's objects");
  ObjectMap map;
  std::string place;
  try {
    const nlohmann::json all = nlohmann::json::parse(text);
    if (all.at("schema").get<std::string>() != "omnimapper-objects" || all.at("version").get<int>() != 1)
      throw std::invalid_argument("is no list of objects of version 1");
    if (all.contains("merged")) map.merged = all.at("merged").get<int>();
    for (const nlohmann::json& entry : all.at("objects")) {
      place = "object " + std::to_string(map.objects.size() + 1) + ": ";
      map.objects.push_back(objectFrom(entry, folder));
    }
  } catch (const nlohmann::json::exception& error) {
    refuse(place, error.what());
  } catch (const std::invalid_argument& error) {
    refuse(place, error.what());
  }
  return map;
}

ObjectMap moved(ObjectMap map, const geometry::Se3& other_from_map) {
  for (MappedObject& object : map.objects) {
    object.map_from_box = other_from_map * object.map_from_box;
    for (Eigen::Vector3d& point : object.points) point = other_from_map * point;
  }
  return map;
}

}  // namespace omnimapper::eval
