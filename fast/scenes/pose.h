// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Between the world and the axes of an object that is placed in it, in the numbers of any stage: docs/scenes.md.

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "fast/domain.h"
#include "fast/meshes/bounded_vector3.h"
#include "fast/meshes/rounded.h"
#include "forceshade/scene.h"

namespace forceshade::fast {

inline bool is_valid(const scene::Pose& pose) noexcept {
  bool is_turned = false;
  for (const float one : pose.rotation) {
    const float size = __builtin_fabsf(one);
    if (size == 0) continue;
    if (!(size >= 0x1p-30F && size <= 2)) return false;
    is_turned = true;
  }
  return is_turned && in_domain(pose.translation);
}

inline bool is_unturned(const scene::Pose& pose) noexcept {
  return pose.rotation[1] == 0 && pose.rotation[2] == 0 && pose.rotation[3] == 0;
}

// R = (rows of A)/length: from the object's axes to the world's.
template <class N>
struct Rotation {
  Vector3<N> x, y, z;  // rows
  N length;

  explicit Rotation(const scene::Pose& pose) noexcept {
    const auto number = [&](std::size_t i) { return N::exactly(static_cast<double>(pose.rotation[i])); };
    const auto twice = [](const N& a) { return a + a; };
    const N w = number(0), i = number(1), j = number(2), k = number(3);
    const N ww = w * w, ii = i * i, jj = j * j, kk = k * k;
    x = {(ww + ii) - (jj + kk), twice(i * j - w * k), twice(i * k + w * j)};
    y = {twice(i * j + w * k), (ww + jj) - (ii + kk), twice(j * k - w * i)};
    z = {twice(i * k - w * j), twice(j * k + w * i), (ww + kk) - (ii + jj)};
    length = (ww + ii) + (jj + kk);
  }

  // Both times `length`.
  Vector3<N> to_world(const Vector3<N>& a) const noexcept { return {dot(x, a), dot(y, a), dot(z, a)}; }
  Vector3<N> to_object(const Vector3<N>& a) const noexcept {
    return meshes::sum(meshes::sum(meshes::scaled(a.x, x), meshes::scaled(a.y, y)), meshes::scaled(a.z, z));
  }
};

// A position of the world as an object sees it: each coordinate of Rᵀ(p - translation) rounded to binary32, and 0 where it is
// below 2^-31 in size. Both in the domain and quantised. Empty where these numbers do not decide.
template <class N>
std::optional<std::array<float, 3>> seen_from(const scene::Pose& pose, const std::array<float, 3>& p,
                                              const std::array<float, 3>& translation) noexcept {
  const Rotation<N> rotation(pose);
  const Vector3<N> away = meshes::point<N>(p.data()) - meshes::point<N>(translation.data());
  return meshes::each([&](const N& one) { return meshes::nearest_quotient(one, rotation.length); }, rotation.to_object(away));
}

// A force in the axes of an object.
struct PlacedForce {
  const scene::Pose* pose = nullptr;
  std::array<float, 3> force{};  // N
};

// The sum of the forces, each turned into the world's axes, rounded to binary32. Empty where these numbers do not decide.
inline std::optional<std::array<float, 3>> filtered_sum(std::span<const PlacedForce> forces) noexcept {
  using N = DoubleWithError;
  Vector3<N> sum{};
  for (const PlacedForce& one : forces) {
    const Rotation<N> rotation(*one.pose);
    const Vector3<N> turned = rotation.to_world(meshes::point<N>(one.force.data()));
    sum = meshes::sum(sum, {turned.x / rotation.length, turned.y / rotation.length, turned.z / rotation.length});
  }
  return meshes::each([](const N& component) { return round_to_binary32(component); }, sum);
}

// The most bits between the first and the last of a number of exact_sum(), and of the tie that it is compared with: a component
// of a quaternion is less than 2^2 and a multiple of 2^-53, so `length` and the entries of A are below 2^6 and multiples of
// 2^-106; a force is below 2^26 N and a multiple of 2^-149. The sum over the product of all lengths then is below
// 2^(6·32 + 34) and a multiple of 2^-(106·32 + 149); a tie, times that product, a multiple of 2^-(106·32 + 150).
constexpr int most_bits_of_sum() {
  constexpr int kObjects = static_cast<int>(scene::kMostObjects);
  return (6 * kObjects + 34) + (106 * kObjects + 150);
}
static_assert(most_bits_of_sum() <= static_cast<int>(64 * meshes::kShadedLimbs));

// The same, which these numbers decide: none of them is rounded.
inline std::optional<std::array<float, 3>> exact_sum(std::span<const PlacedForce> forces) noexcept {
  using N = meshes::Shaded;
  Vector3<N> sum{};
  N length = N::exactly(1);
  for (const PlacedForce& one : forces) {
    const Rotation<N> rotation(*one.pose);
    const Vector3<N> turned = rotation.to_world(meshes::point<N>(one.force.data()));
    sum = meshes::sum(meshes::scaled(rotation.length, sum), meshes::scaled(length, turned));
    length = length * rotation.length;
  }
  return meshes::each([&](const N& component) { return meshes::nearest_quotient(component, length); }, sum);
}

}  // namespace forceshade::fast
