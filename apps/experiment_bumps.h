// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What an experiment renders, as subjects: each bump of a protocol with its definition, its renderer and its identity.

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "forceshade/properties.h"
#include "study/experiments/session.h"

namespace forceshade::apps {

// "bump-1p-shaded, 640 mil"
std::string words_of(const experiments::Bump& bump);

class Bumps {
 public:
  explicit Bumps(experiments::Protocol protocol) : protocol_(std::move(protocol)) {}

  // Of this stimulus and radius, wherever it stands; kept for the next call. Throws BadInput, heights::Error or mesh::Error for
  // what cannot be rendered. The protocol's height maps and meshes are read as `drive` reads them without further options.
  const properties::Subject& of(const experiments::Bump& bump);

  // mm, where its middle stands in the device's frame if the scene's origin is there.
  static Eigen::Vector3f place_of(const experiments::Bump& bump, const Eigen::Vector3f& origin);

  // mm, of the surface where the force begins, at so many mm from its middle; for the eye alone. A mesh is taken for flat.
  double height(const experiments::Bump& bump, double x);

  const experiments::Protocol& protocol() const { return protocol_; }

 private:
  struct Kept {
    std::shared_ptr<const properties::Subject> subject;
    std::unique_ptr<fast::Session> looked_at;  // by height()
  };
  Kept& kept(const experiments::Bump& bump);

  experiments::Protocol protocol_;
  std::map<std::pair<std::string, experiments::Mil>, Kept> kept_;
};

}  // namespace forceshade::apps
