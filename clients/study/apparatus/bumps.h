// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Renders the bumps of an experiment: each bump of a protocol as it is described and as it is driven.

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "forceshade/description.h"
#include "forceshade/renderer.h"
#include "study/experiments/protocol.h"
#include "subjects/options.h"

namespace forceshade::apparatus {

// "bump-1p-shaded, 640 mil"
std::string words_of(const experiments::Bump& bump);

class Bumps {
 public:
  using Read = std::function<Description(const subjects::Options& options)>;

  // read: read_until(), or one that shows how far the check of a mesh is.
  explicit Bumps(experiments::Protocol protocol, Read read) : protocol_(std::move(protocol)), read_(std::move(read)) {}

  // The description of this stimulus and radius, wherever it stands. Throws Error where it
  // cannot be rendered. The protocol's height maps and meshes are read as `drive` reads them without further options.
  Description description(const experiments::Bump& bump) const;

  // The same as it is driven; kept for the next call.
  const Rendering& of(const experiments::Bump& bump);

  // The one damping that all bumps have, at a rate in Hz. Throws Error where it is not one, and as description() does.
  damping::Parameters damping(double rate);

  // mm, where its middle stands in the device's frame if the scene's origin is there.
  static Eigen::Vector3f place_of(const experiments::Bump& bump, const Eigen::Vector3f& origin);

  // mm, of the surface where the force begins, at so many mm from its middle; for the eye alone. A mesh is taken for flat.
  double height(const experiments::Bump& bump, double x);

  const experiments::Protocol& protocol() const { return protocol_; }

 private:
  struct Kept {
    std::optional<Rendering> rendering;
    std::unique_ptr<fast::Session> looked_at;  // by height()
  };
  Kept& kept(const experiments::Bump& bump);

  experiments::Protocol protocol_;
  Read read_;
  std::map<std::pair<std::string, experiments::Mil>, Kept> kept_;
};

// Reads a subject, and throws Interrupted once stop, which lives longer, is set.
Bumps::Read read_until(const std::atomic<bool>& stop);

}  // namespace forceshade::apparatus
