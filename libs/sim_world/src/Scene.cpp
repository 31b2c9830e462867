#include <embree3/rtcore.h>
#include <omnimapper/base/Error.h>
#include <omnimapper/sim_world/Scene.h>

#include <algorithm>
#include <map>
#include <mutex>
#include <set>

namespace omnimapper::sim {

namespace {

constexpr int kPacket = 8;
constexpr double kEdgeOn = 1e-3;  // largest error of ranges in single precision [m]

// All scenes of the process share one device, which holds no state of theirs.
RTCDevice device() {
  static const RTCDevice instance = rtcNewDevice("threads=1,set_affinity=0");
  return instance;
}

}  // namespace

/// Bodies at one time, built for ray casting.
class Scene::Part {
 public:
  Part() : scene_(rtcNewScene(device())) { rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST); }
  ~Part() { rtcReleaseScene(scene_); }
  Part(const Part&) = delete;
  Part& operator=(const Part&) = delete;

  void add(const Body& body, const geometry::Se3& map_from_body, int first_surface) {
    std::vector<Eigen::Vector3d> vertices;
    for (const Eigen::Vector3d& vertex : body.vertices_in_body) vertices.push_back(map_from_body * vertex);
    for (const Triangle& triangle : body.triangles) {
      const auto& [a, b, c] = triangle.corners;
      const Eigen::Vector3d normal = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]);
      if (normal.norm() < 1e-12) continue;  // no area: no ray meets it
      placed_.push_back({vertices[a], normal.normalized(), triangle.texture_at, first_surface + triangle.surface});
      for (const int corner : triangle.corners) {
        for (int axis = 0; axis < 3; ++axis) corners_.push_back(static_cast<float>(vertices[corner][axis]));
      }
    }
  }

  void finish() {
    if (placed_.empty()) return;
    const RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const std::size_t count = placed_.size();
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count));
    auto* indices = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
    if (!vertices || !indices) throw base::Error(base::ExitCode::internal, "simulated world: no memory for its scene");
    std::copy(corners_.begin(), corners_.end(), vertices);
    for (std::size_t i = 0; i < 3 * count; ++i) indices[i] = static_cast<unsigned>(i);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
    std::vector<float>().swap(corners_);
  }

  bool isEmpty() const { return placed_.empty(); }
  RTCScene handle() const { return scene_; }

  /// Takes the hit of a ray on a triangle that Embree found, if it is the nearest. The range is computed in doubles,
  /// because Embree's own range is in single precision.
  void take(const Ray& ray, unsigned triangle, float u, float v, Hit& hit) const {
    const Placed& placed = placed_[triangle];
    const double along = placed.normal.dot(ray.direction_in_map);
    if (along == 0) return;
    const double range = placed.normal.dot(placed.corner - ray.origin_in_map) / along;
    // A triangle that is met edge-on may be hit in single precision and missed in doubles.
    if (range < ray.near || range > ray.far + kEdgeOn || range >= hit.range) return;
    hit.range = range;
    hit.surface = placed.surface;
    hit.normal_in_map = along > 0 ? Eigen::Vector3d(-placed.normal) : placed.normal;
    hit.texture_at = (1 - u - v) * placed.texture_at[0] + u * placed.texture_at[1] + v * placed.texture_at[2];
  }

 private:
  /// A triangle in the map, as a hit needs it.
  struct Placed {
    Eigen::Vector3d corner, normal;
    std::array<Eigen::Vector2f, 3> texture_at;
    int surface;
  };

  RTCScene scene_;
  std::vector<Placed> placed_;
  std::vector<float> corners_;
};

namespace {

// Loads rays first to first + kPacket of a list in Embree's layout. Lanes beyond the list are off.
template <class Packet>
void load(const Ray* rays, std::size_t count, std::size_t first, Packet& packet, int* valid) {
  for (int lane = 0; lane < kPacket; ++lane) {
    valid[lane] = first + lane < count ? -1 : 0;
    const Ray& ray = rays[std::min(first + lane, count - 1)];
    packet.org_x[lane] = static_cast<float>(ray.origin_in_map.x());
    packet.org_y[lane] = static_cast<float>(ray.origin_in_map.y());
    packet.org_z[lane] = static_cast<float>(ray.origin_in_map.z());
    packet.dir_x[lane] = static_cast<float>(ray.direction_in_map.x());
    packet.dir_y[lane] = static_cast<float>(ray.direction_in_map.y());
    packet.dir_z[lane] = static_cast<float>(ray.direction_in_map.z());
    packet.tnear[lane] = static_cast<float>(ray.near);
    packet.tfar[lane] = static_cast<float>(ray.far);
    packet.time[lane] = 0;
    packet.mask[lane] = ~0u;
    packet.id[lane] = 0;
    packet.flags[lane] = 0;
  }
}

RTCIntersectContext coherentContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

}  // namespace

void Scene::cast(const std::vector<Ray>& rays, std::vector<Hit>& hits) const {
  hits.resize(rays.size());
  cast(rays.data(), rays.size(), hits.data());
}

void Scene::cast(const Ray* rays, std::size_t count, Hit* hits) const {
  std::fill(hits, hits + count, Hit{});
  RTCIntersectContext context = coherentContext();
  alignas(32) int valid[kPacket];
  RTCRayHit8 packet;
  for (const auto& part : parts_) {
    if (part->isEmpty()) continue;
    for (std::size_t first = 0; first < count; first += kPacket) {
      load(rays, count, first, packet.ray, valid);
      std::fill(packet.hit.geomID, packet.hit.geomID + kPacket, RTC_INVALID_GEOMETRY_ID);
      rtcIntersect8(valid, part->handle(), &context, &packet);
      for (int lane = 0; lane < kPacket && valid[lane]; ++lane) {
        if (packet.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) continue;
        part->take(rays[first + lane], packet.hit.primID[lane], packet.hit.u[lane], packet.hit.v[lane],
                   hits[first + lane]);
      }
    }
  }
}

Hit Scene::cast(const Ray& ray) const {
  Hit hit;
  cast(&ray, 1, &hit);
  return hit;
}

void Scene::findBlocked(const std::vector<Ray>& rays, std::vector<char>& blocked) const {
  blocked.resize(rays.size());
  findBlocked(rays.data(), rays.size(), blocked.data());
}

void Scene::findBlocked(const Ray* rays, std::size_t count, char* blocked) const {
  std::fill(blocked, blocked + count, 0);
  RTCIntersectContext context = coherentContext();
  alignas(32) int valid[kPacket];
  RTCRay8 packet;
  for (const auto& part : parts_) {
    if (part->isEmpty()) continue;
    for (std::size_t first = 0; first < count; first += kPacket) {
      load(rays, count, first, packet, valid);
      rtcOccluded8(valid, part->handle(), &context, &packet);
      for (int lane = 0; lane < kPacket && valid[lane]; ++lane) {
        if (packet.tfar[lane] < 0) blocked[first + lane] = 1;  // Embree marks a blocked ray by -infinity
      }
    }
  }
}

/// Parts of the bodies that stand still, by the time since when they do, and the part of the bodies that move at their
/// last poses.
struct Scenes::Cache {
  std::set<double> changes;  // times at which something that is carried changes its place [s]
  std::mutex mutex;
  std::map<double, std::shared_ptr<const Scene::Part>> standing;
  std::vector<double> moving_poses;  // parameters of the poses of all bodies in `moving`
  std::shared_ptr<const Scene::Part> moving;
};

namespace {

// Parameters of the poses of all moving bodies. People stand more often than they walk, and then these do not change.
std::vector<double> posesOfMoving(const World& world, double time) {
  std::vector<double> numbers;
  for (const Body& body : world.bodies) {
    if (body.track.kind() != Track::Kind::motion) continue;
    const geometry::Se3 map_from_body = *body.track.at(time);
    const Eigen::Vector3d& t = map_from_body.translation;
    const Eigen::Vector4d& q = map_from_body.rotation.coeffs();
    numbers.insert(numbers.end(), {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()});
  }
  return numbers;
}

}  // namespace

Scenes::Scenes(const World& world) : world_(world), cache_(std::make_unique<Cache>()) {
  int next = 0;
  for (const Body& body : world.bodies) {
    first_surface_.push_back(next);
    next += static_cast<int>(body.surfaces.size());
    for (const Surface& surface : body.surfaces) materials_.push_back(&surface.material);
    if (body.track.kind() != Track::Kind::steps) continue;
    for (const Track::Place& place : body.track.places()) cache_->changes.insert(place.time);
  }
}

Scenes::~Scenes() = default;

Scene Scenes::at(double time) const {
  const auto build = [&](Track::Kind kind) {
    auto part = std::make_shared<Scene::Part>();
    for (std::size_t i = 0; i < world_.bodies.size(); ++i) {
      const Body& body = world_.bodies[i];
      if (body.track.kind() != kind) continue;
      if (const auto map_from_body = body.track.at(time)) part->add(body, *map_from_body, first_surface_[i]);
    }
    part->finish();
    return part;
  };
  const auto after = cache_->changes.upper_bound(time);
  const double since = after == cache_->changes.begin() ? -std::numeric_limits<double>::infinity() : *std::prev(after);
  std::shared_ptr<const Scene::Part> standing;
  {
    const std::lock_guard lock(cache_->mutex);
    auto& cached = cache_->standing[since];
    if (!cached) cached = build(Track::Kind::steps);
    standing = cached;
    // A run goes forward in time, so parts of more than two changes ago are not needed again soon.
    while (cache_->standing.size() > 3) cache_->standing.erase(cache_->standing.begin());
  }
  std::shared_ptr<const Scene::Part> moving;
  std::vector<double> poses = posesOfMoving(world_, time);
  {
    const std::lock_guard lock(cache_->mutex);
    if (cache_->moving && cache_->moving_poses == poses) moving = cache_->moving;
  }
  if (!moving) {
    moving = build(Track::Kind::motion);
    const std::lock_guard lock(cache_->mutex);
    cache_->moving = moving;
    cache_->moving_poses = std::move(poses);
  }
  if (moving->isEmpty()) return Scene({standing});
  return Scene({standing, moving});
}

}  // namespace omnimapper::sim
