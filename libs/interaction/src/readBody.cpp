#include <omnimapper/geometry/Conversions.h>
#include <omnimapper/interaction/readBody.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace omnimapper::interaction {

namespace {

using Eigen::Vector3d;
using mrpt::obs::CObservationSkeleton;
using TrackedJoint = CObservationSkeleton::TSkeletonJoint;

bool isKnown(const TrackedJoint& joint, bool has_confidence) {
  const Vector3d at(joint.x, joint.y, joint.z);
  return at.allFinite() && at.norm() > 0 && !(has_confidence && !(joint.conf > 0));
}

std::vector<const TrackedJoint*> jointsOf(const CObservationSkeleton& s) {
  return {&s.head,        &s.neck,       &s.torso,     &s.left_shoulder, &s.left_elbow,
          &s.left_hand,   &s.left_hip,   &s.left_knee, &s.left_foot,     &s.right_shoulder,
          &s.right_elbow, &s.right_hand, &s.right_hip, &s.right_knee,    &s.right_foot};
}

TrackedBody bodyOf(const CObservationSkeleton& s, const SkeletonFormat& format) {
  const auto joints = jointsOf(s);
  const bool has_confidence = std::any_of(joints.begin(), joints.end(), [](const auto* j) { return j->conf > 0; });
  const auto read = [&](const TrackedJoint& joint) -> std::optional<BodyJoint> {
    if (!isKnown(joint, has_confidence)) return std::nullopt;
    return BodyJoint{{joint.x, joint.y, joint.z}, has_confidence && joint.conf < format.guessed_confidence};
  };
  TrackedBody body;
  body.head = read(s.head);
  body.neck = read(s.neck);
  body.torso = read(s.torso);
  body.left = {read(s.left_shoulder), read(s.left_elbow), read(s.left_hand)};
  body.right = {read(s.right_shoulder), read(s.right_elbow), read(s.right_hand)};
  if (format.is_mirrored) std::swap(body.left, body.right);
  return body;
}

std::vector<double> limbLengths(const TrackedBody& body) {
  std::vector<double> lengths;
  const auto add = [&](const std::optional<BodyJoint>& a, const std::optional<BodyJoint>& b) {
    if (a && b) lengths.push_back((a->at - b->at).norm());
  };
  for (const auto* arm : {&body.left, &body.right}) {
    add(arm->shoulder, arm->elbow);
    add(arm->elbow, arm->hand);
  }
  add(body.head, body.neck);
  add(body.neck, body.torso);
  add(body.head, body.torso);
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

// From lower to upper joints of the trunk, in the axes of the tracker; zero if too few are known.
Vector3d trunkOf(const CObservationSkeleton& s, bool has_confidence) {
  const auto meanOf = [&](std::initializer_list<const TrackedJoint*> joints) -> std::optional<Vector3d> {
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (const auto* joint : joints)
      if (isKnown(*joint, has_confidence)) sum += Vector3d(joint->x, joint->y, joint->z), ++count;
    if (count == 0) return std::nullopt;
    return sum / count;
  };
  const auto head = meanOf({&s.head}), shoulders = meanOf({&s.neck, &s.left_shoulder, &s.right_shoulder}),
             torso = meanOf({&s.torso, &s.left_hip, &s.right_hip});
  const auto& upper = head ? head : shoulders;
  const auto& lower = torso ? torso : shoulders;
  return upper && lower ? Vector3d(*upper - *lower) : Vector3d::Zero();
}

Eigen::Matrix3d matrixOf(SkeletonAxes axes) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  if (axes == SkeletonAxes::flipped_y) matrix.diagonal() << 1, -1, 1;
  if (axes == SkeletonAxes::forward_y_up) matrix << 0, 0, 1, -1, 0, 0, 0, 1, 0;
  if (axes == SkeletonAxes::forward_optical) matrix << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return matrix;
}

std::optional<SkeletonAxes> recognisedAxes(const Vector3d& trunk, const Eigen::Matrix3d& base_from_sensor) {
  std::optional<SkeletonAxes> best;
  double most = std::sqrt(0.5);  // of the cosine between trunk and vertical
  for (const auto axes :
       {SkeletonAxes::sensor, SkeletonAxes::flipped_y, SkeletonAxes::forward_y_up, SkeletonAxes::forward_optical}) {
    const double upright = (base_from_sensor * (matrixOf(axes) * trunk)).z() / trunk.norm();
    if (upright > most) {
      best = axes;
      most = upright;
    }
  }
  return best;
}

}  // namespace

const base::OptionTable<SkeletonFormat>& SkeletonFormat::table() {
  using F = SkeletonFormat;
  static const auto table =
      base::OptionTable<F>()
          .choice("skeleton_unit", &F::unit,
                  {{"recognised", SkeletonUnit::recognised}, {"m", SkeletonUnit::m}, {"mm", SkeletonUnit::mm}},
                  "Unit of the joints of skeletons; it is recognised by the lengths of limbs.")
          .choice("skeleton_axes", &F::axes,
                  {{"recognised", SkeletonAxes::recognised},
                   {"sensor", SkeletonAxes::sensor},
                   {"flipped_y", SkeletonAxes::flipped_y},
                   {"forward_y_up", SkeletonAxes::forward_y_up},
                   {"forward_optical", SkeletonAxes::forward_optical}},
                  "Axes of the joints of skeletons. They are recognised by the body, which stands or sits. sensor: "
                  "those of the sensor pose; flipped_y: the same with y upwards where the sensor has y downwards; "
                  "forward_y_up and forward_optical: x right, z ahead and y upwards or downwards, where the sensor "
                  "pose has x ahead and z upwards.")
          .flag("mirrored", &F::is_mirrored, "The tracker calls the right side of a person left.")
          .number("guessed_confidence", &F::guessed_confidence, {0, 1},
                  "Confidence below which a joint counts as guessed; one with confidence 0 is unknown.");
  return table;
}

BodyReading readBody(const CObservationSkeleton& skeleton, const SkeletonFormat& format) {
  TrackedBody body = bodyOf(skeleton, format);
  const auto canPoint = [&](const BodyArm& arm) { return arm.hand && (arm.elbow || body.head); };
  if (!canPoint(body.left) && !canPoint(body.right))
    return {std::nullopt, "no hand is known together with its elbow or the head"};
  const auto lengths = limbLengths(body);
  constexpr double kLongest = 3, kMillimetre = 1e-3;  // between limbs in metres and in millimetres
  const double median = lengths.empty() ? 0 : lengths[lengths.size() / 2];
  const bool is_mm = format.unit == SkeletonUnit::mm || (format.unit == SkeletonUnit::recognised && median > kLongest);
  if (median * (is_mm ? kMillimetre : 1) > 1) return {std::nullopt, "its limbs are longer than 1 m"};

  const geometry::Se3 base_from_sensor = geometry::fromMrpt(skeleton.sensorPose);
  SkeletonAxes axes = format.axes;
  if (axes == SkeletonAxes::recognised) {
    const auto joints = jointsOf(skeleton);
    const bool has_confidence = std::any_of(joints.begin(), joints.end(), [](const auto* j) { return j->conf > 0; });
    const Vector3d trunk = trunkOf(skeleton, has_confidence);
    const auto recognised =
        trunk.norm() > 0 ? recognisedAxes(trunk, base_from_sensor.rotation.toRotationMatrix()) : std::nullopt;
    if (!recognised) return {std::nullopt, "with no axes its trunk stands upright (skeleton_axes declares them)"};
    axes = *recognised;
  }
  const Eigen::Matrix3d in_sensor = (is_mm ? kMillimetre : 1) * matrixOf(axes);
  body = transformed(in_sensor, std::move(body));
  return {transformed(base_from_sensor, std::move(body)), ""};
}

}  // namespace omnimapper::interaction
