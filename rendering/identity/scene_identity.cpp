// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/identity.h"
#include "rendering/identity/digest.h"

namespace forceshade {
namespace {

void add_identity(const Identity& its, Digest& digest) {
  // Files may be renamed: a name counts only where there is no digest.
  digest.line("object " + its.kind + ' ' + (its.digest.empty() ? its.name : its.digest));
  for (const auto& [key, value] : its.parameters) digest.line(key + ' ' + text_of(value));
}

void add_motion(const scene::Motion& motion, Digest& digest) {
  digest.line("poses " + std::to_string(motion.poses.size()) + (motion.repeats ? " repeated" : ""));
  for (const scene::Pose& pose : motion.poses) {
    for (const float coordinate : pose.translation) digest.number(coordinate);
    for (const float component : pose.rotation) digest.number(component);
  }
}

}  // namespace

Identity identity_of(const std::string& name, const DescribedScene& scene) {
  Digest digest;
  for (const MovingObject& one : scene.objects) {
    add_identity(identity_of(one.what), digest);
    add_motion(one.motion, digest);
  }
  return {kSceneKind, name, {{"objects", std::to_string(scene.objects.size())}, {"rate_Hz", scene.rate}}, digest.hex()};
}

Identity identity_of(const Description& description) {
  const std::string& name = description.name;
  return description.visit([](const DescribedLaw& law) { return identity_of(law.law, law.parameters); },
                           [&](const DescribedHeightMap& map) { return identity_of(name, map.map, map.mode, map.stiffness); },
                           [&](const auto& other) { return identity_of(name, other); });
}

}  // namespace forceshade
