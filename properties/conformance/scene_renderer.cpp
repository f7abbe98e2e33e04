// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace forceshade::conformance {
namespace {

// 1000 is 125 times a power of two, so that 1000 times a number of 17 bits has at most 24.
constexpr int kBitsOfMetres = 17;

float rounded_to_metres(float millimetres) {
  if (!std::isfinite(millimetres)) return millimetres;
  int exponent = 0;
  const double part = std::frexp(static_cast<double>(millimetres) / 1000, &exponent);
  const auto metres = static_cast<float>(std::ldexp(std::nearbyint(std::ldexp(part, kBitsOfMetres)), exponent - kBitsOfMetres));
  return static_cast<float>(1000.0 * static_cast<double>(metres));
}

// The position itself as the closest point is no contact, also where it is infinite or not a number.
Eigen::Vector3d pull(const Eigen::Vector3d& position, const Eigen::Vector3d& point, double stiffness) {
  const auto is_itself = point.array() == position.array() || (point.array().isNaN() && position.array().isNaN());
  return is_itself.select(Eigen::Array3d::Zero(), (stiffness * (point - position)).array());
}

}  // namespace

SceneRenderer::SceneRenderer(std::unique_ptr<RendererUnderTest> renderer, float stiffness)
    : renderer_(std::move(renderer)), stiffness_(static_cast<double>(stiffness)) {}

Eigen::Vector3f SceneRenderer::writable(const Eigen::Vector3f& position) const {
  return hello().millimetres == 1 ? position : position.unaryExpr(&rounded_to_metres);
}

bool SceneRenderer::is_in_domain(const Eigen::Vector3f& position) const {
  constexpr float kAllPositions = 10'000;  // beyond it there is no force, which is an answer, too
  return hello().domain >= kAllPositions || (position.array().abs() <= hello().domain).all();
}

Eigen::Vector3f SceneRenderer::to_its_units(const Eigen::Vector3f& position) const {
  Eigen::Vector3f own;
  for (std::size_t i = 0; i < 3; ++i) {
    const Axis axis = hello().frame[i];
    const auto one =
        static_cast<float>(static_cast<double>(position[static_cast<Eigen::Index>(axis.index)]) / hello().millimetres);
    own[static_cast<Eigen::Index>(i)] = axis.is_opposite ? -one : one;
  }
  return own;
}

Eigen::Vector3f SceneRenderer::force_of(const Eigen::Vector3f& answer, const Eigen::Vector3f& position) const {
  Eigen::Vector3d turned;
  for (std::size_t i = 0; i < 3; ++i) {
    const Axis axis = hello().frame[i];
    const auto one = static_cast<double>(answer[static_cast<Eigen::Index>(i)]);
    turned[static_cast<Eigen::Index>(axis.index)] = axis.is_opposite ? -one : one;
  }
  switch (hello().answer) {
    case Answer::impulse: turned *= hello().newtons * *hello().rate; break;
    case Answer::closest_point: turned = pull(position.cast<double>(), turned * hello().millimetres, stiffness_); break;
    default: turned *= hello().newtons;
  }
  return turned.cast<float>();
}

std::vector<Eigen::Vector3f> SceneRenderer::forces(std::span<const Eigen::Vector3f> positions, bool is_reset,
                                                   std::span<const std::uint32_t> periods) {
  if (!hello().has_own_units()) return renderer_->answers(positions, is_reset, periods);
  std::vector<Eigen::Vector3f> own(positions.size());
  std::ranges::transform(positions, own.begin(), [this](const Eigen::Vector3f& one) { return to_its_units(one); });
  std::vector<Eigen::Vector3f> forces = renderer_->answers(own, is_reset, periods);
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = force_of(forces[i], positions[i]);
  return forces;
}

std::vector<Eigen::Vector3f> SceneRenderer::forces_along(std::span<const Eigen::Vector3f> path,
                                                         std::span<const std::uint32_t> periods) {
  std::vector<Eigen::Vector3f> all;
  for (std::size_t begin = 0; begin < path.size(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, path.size() - begin);
    const auto some = forces(path.subspan(begin, count), begin == 0, periods.empty() ? periods : periods.subspan(begin, count));
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace forceshade::conformance
