// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <numbers>
#include <optional>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include "forceshade/meshes.h"
#include "rendering/half_edges.h"
#include "rendering/meshes/creases.h"
#include "rendering/meshes/doubtful_normals.h"
#include "rendering/meshes/weld.h"

namespace forceshade::mesh {
namespace {

constexpr double kEpsilon = 0x1p-53;
// The bound of the relative error of the C library's atan2 and cos: 8 units in the last place, of which glibc documents 1.
constexpr double kLibrary = 0x1p-50;

// The corner that half-edge h starts at, and the two that follow.
TrianglePoints points_from(const TriangleMesh& mesh, std::uint32_t h) {
  const std::uint32_t next = next_in_triangle(h);
  return {mesh.vertices[start_of(mesh, h)], mesh.vertices[start_of(mesh, next)], mesh.vertices[end_of(mesh, next)]};
}

// The part of a triangle at a corner: its unit normal and its angle, in binary64, with bounds of their errors. A bound is at
// least twice what the roundings add up to in first order (epsilon = 2^-53 each), which covers the higher orders and the
// roundings of the bound itself while errors are below 2^-10; else the part is of no use.
struct Part {
  bool is_of_use = false;
  std::array<double, 3> unit{}, unit_error{};
  double angle = 0, angle_error = 0;
};

Part part_of(const TrianglePoints& t) {
  std::array<double, 3> u{}, v{}, n{}, n_error{};
  for (std::size_t i = 0; i < 3; ++i) {
    u[i] = static_cast<double>(t[1][i]) - static_cast<double>(t[0][i]);
    v[i] = static_cast<double>(t[2][i]) - static_cast<double>(t[0][i]);
  }
  double dot = 0, dot_size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double a = u[j] * v[k], b = u[k] * v[j];
    n[i] = a - b;
    n_error[i] = 8 * kEpsilon * (std::fabs(a) + std::fabs(b));  // two differences and a product each, then a difference
    dot += u[i] * v[i];
    dot_size += std::fabs(u[i] * v[i]);
  }
  const double dot_error = 12 * kEpsilon * dot_size;
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  const double relative = (n_error[0] + n_error[1] + n_error[2]) / length + 8 * kEpsilon;
  Part part;
  if (!(relative < 0x1p-10)) return part;
  for (std::size_t i = 0; i < 3; ++i) {
    part.unit[i] = n[i] / length;
    part.unit_error[i] = 2 * n_error[i] / length + std::fabs(part.unit[i]) * (2 * relative + 4 * kEpsilon);
  }
  part.angle = std::atan2(length, dot);
  // A point in the plane that moves by so much is seen under an angle that changes by that over its distance.
  const double moved = 2 * (length * relative + dot_error) / std::max(length, std::fabs(dot));
  part.angle_error = 2 * moved + part.angle * kLibrary;
  part.is_of_use = moved < 0x1p-10;
  return part;
}

// True if the triangles turn by more than the angle.
bool separates(const TriangleMesh& mesh, std::uint32_t h, std::uint32_t other, double degrees) {
  const TrianglePoints s = points_from(mesh, h), t = points_from(mesh, other);
  const Part a = part_of(s), b = part_of(t);
  if (a.is_of_use && b.is_of_use) {
    double cosine = 0, error = 16 * kEpsilon + 2 * kLibrary;
    for (std::size_t i = 0; i < 3; ++i) {
      cosine += a.unit[i] * b.unit[i];
      error += 2 * (a.unit_error[i] * std::fabs(b.unit[i]) + b.unit_error[i] * std::fabs(a.unit[i]));
    }
    const double limit = std::cos(degrees * (std::numbers::pi / 180));
    if (cosine < limit - error) return true;
    if (cosine > limit + error) return false;
  }
  return turns_by_more(s, t, degrees);
}

// The components that the parts' errors leave no doubt of.
std::array<std::optional<float>, 3> normal_in_binary64(const std::vector<Part>& parts) {
  std::array<double, 3> sum{}, error{}, size{};
  for (const Part& part : parts) {
    if (!part.is_of_use) return {};
    for (std::size_t i = 0; i < 3; ++i) {
      const double term = part.angle * part.unit[i];
      sum[i] += term;
      size[i] += std::fabs(term);
      error[i] += 2 * (part.angle * part.unit_error[i] + part.angle_error * std::fabs(part.unit[i]));
    }
  }
  const double roundings = 2 * kEpsilon * (static_cast<double>(parts.size()) + 2);
  for (std::size_t i = 0; i < 3; ++i) error[i] += roundings * size[i];
  const double length = std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  const double relative = (error[0] + error[1] + error[2]) / length + 8 * kEpsilon;
  if (!(relative < 0x1p-10)) return {};
  std::array<std::optional<float>, 3> normal;
  for (std::size_t i = 0; i < 3; ++i) {
    const double exact = sum[i] / length;
    const double bound = 2 * error[i] / length + std::fabs(exact) * (2 * relative + 8 * kEpsilon);
    const auto low = static_cast<float>(exact - bound), high = static_cast<float>(exact + bound);
    if (low == high) normal[i] = low == 0 ? 0.0F : low;
  }
  return normal;
}

class Computation {
 public:
  Computation(const TriangleMesh& mesh, double crease_degrees, CornerNormals& normals)
      : mesh_(mesh), crease_(crease_degrees), opposite_(opposite_half_edges(mesh)), normals_(normals) {}

  // Computes the normals of the vertices with these first half-edges.
  NormalStages run(std::span<const std::uint32_t> first) const {
    NormalStages stages;
    std::vector<std::uint32_t> fan, group;
    for (const std::uint32_t h : first) {
      if (h == kNoEdge) continue;
      fan_of(h, fan);
      std::size_t begin = 0;
      const bool is_closed = opposite_[fan.front()] != kNoEdge;
      if (is_closed) {  // so that the fan begins behind an edge that separates, if there is one
        while (begin < fan.size() && !separates_behind(fan, (begin + fan.size() - 1) % fan.size())) ++begin;
        std::rotate(fan.begin(), fan.begin() + static_cast<std::ptrdiff_t>(begin % fan.size()), fan.end());
      }
      group.clear();
      for (std::size_t i = 0; i < fan.size(); ++i) {
        group.push_back(fan[i]);
        if (i + 1 == fan.size() || separates_behind(fan, i)) {
          set_normal(group, stages);
          group.clear();
        }
      }
    }
    return stages;
  }

 private:
  // Every half-edge that starts where h does, each behind the one that shares its edge, from the rim on if there is one.
  void fan_of(std::uint32_t h, std::vector<std::uint32_t>& fan) const {
    std::uint32_t begin = h;
    for (std::uint32_t at = opposite_[h]; at != kNoEdge; at = opposite_[begin]) {
      begin = next_in_triangle(at);
      if (begin == h) break;
    }
    fan.clear();
    std::uint32_t at = begin;
    do {
      fan.push_back(at);
      at = opposite_[previous_in_triangle(at)];
    } while (at != kNoEdge && at != begin);
  }

  // True if the edge between a triangle of a fan and the next one separates them.
  bool separates_behind(const std::vector<std::uint32_t>& fan, std::size_t i) const {
    return crease_ < 180 && separates(mesh_, fan[i], fan[(i + 1) % fan.size()], crease_);
  }

  void set_normal(const std::vector<std::uint32_t>& group, NormalStages& stages) const {
    std::vector<Part> parts;
    for (const std::uint32_t h : group) parts.push_back(part_of(points_from(mesh_, h)));
    const std::array<std::optional<float>, 3> decided = normal_in_binary64(parts);
    const auto count = static_cast<std::uint64_t>(decided[0].has_value()) + decided[1].has_value() + decided[2].has_value();
    stages.binary64 += count;
    stages.intervals += 3 - count;
    Normal normal{};
    if (count == 3) {
      normal = {*decided[0], *decided[1], *decided[2]};
    } else {
      std::vector<TrianglePoints> triangles;
      for (const std::uint32_t h : group) triangles.push_back(points_from(mesh_, h));
      normal = normal_in_intervals(triangles);
    }
    for (const std::uint32_t h : group) normals_[h / 3][h % 3] = normal;
  }

  const TriangleMesh& mesh_;
  double crease_;
  std::vector<std::uint32_t> opposite_;
  CornerNormals& normals_;
};

// first: a half-edge of each fan.
ComputedNormals normals_of(const TriangleMesh& mesh, double crease_degrees, std::span<const std::uint32_t> first) {
  ComputedNormals result{CornerNormals(mesh.triangles.size()), {}};
  const Computation computation(mesh, crease_degrees, result.normals);
  // Each thread does a part of the fans, of which each has corners of its own.
  const std::size_t threads = mesh.triangles.size() < 10000 ? 1 : std::clamp(std::thread::hardware_concurrency(), 1U, 8U);
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&](std::size_t i) {
    const std::size_t begin = first.size() * i / threads, end = first.size() * (i + 1) / threads;
    try {
      const NormalStages stages = computation.run(first.subspan(begin, end - begin));
      const std::lock_guard lock(mutex);
      result.stages.binary64 += stages.binary64;
      result.stages.intervals += stages.intervals;
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  };
  std::vector<std::jthread> others;
  for (std::size_t i = 1; i < threads; ++i) others.emplace_back(work, i);
  work(0);
  others.clear();
  if (failure) std::rethrow_exception(failure);
  return result;
}

ComputedNormals normals_of_soup(const TriangleMesh& mesh, double crease_degrees) {
  const auto [triangles, number] = welded(mesh);
  const std::vector<std::uint32_t> opposite = opposite_half_edges(triangles);
  std::vector<bool> is_met(opposite.size(), false);
  std::vector<std::uint32_t> first;
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    if (is_met[h]) continue;
    first.push_back(h);
    walk_around(opposite, h, [&](std::uint32_t at) { is_met[at] = true; });
  }
  ComputedNormals its = normals_of(triangles, crease_degrees, first), result{CornerNormals(mesh.triangles.size()), its.stages};
  for (std::size_t i = 0; i < number.size(); ++i) result.normals[number[i]] = its.normals[i];
  return result;
}

}  // namespace

ComputedNormals corner_normals(const CheckedMesh& checked, double crease_degrees) {
  if (!(crease_degrees >= 0 && crease_degrees <= 180))
    throw std::invalid_argument("expected a crease angle of 0 to 180 degrees");
  const TriangleMesh& mesh = checked.mesh();
  if (!checked.is_regular()) return normals_of_soup(mesh, crease_degrees);
  std::vector<std::uint32_t> first(mesh.vertices.size(), kNoEdge);
  for (auto h = static_cast<std::uint32_t>(3 * mesh.triangles.size()); h-- > 0;) first[start_of(mesh, h)] = h;
  return normals_of(mesh, crease_degrees, first);
}

}  // namespace forceshade::mesh
