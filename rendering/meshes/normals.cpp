// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <exception>
#include <mutex>
#include <numbers>
#include <span>
#include <stdexcept>
#include <thread>
#include <vector>

#include "forceshade/meshes.h"
#include "rendering/half_edges.h"
#include "rendering/meshes/bounded_number.h"
#include "rendering/meshes/creases.h"
#include "rendering/meshes/doubtful_normals.h"
#include "rendering/meshes/weld.h"
#include "rendering/vectors.h"

namespace forceshade::mesh {
namespace {

// The corner that half-edge h starts at, and the two that follow.
TrianglePoints points_from(const TriangleMesh& mesh, std::uint32_t h) {
  const std::uint32_t next = next_in_triangle(h);
  return {mesh.vertices[start_of(mesh, h)], mesh.vertices[start_of(mesh, next)], mesh.vertices[end_of(mesh, next)]};
}

// True if the triangles turn by more than the angle.
bool separates(const TrianglePoints& s, const TrianglePoints& t, double degrees) {
  const auto normal = [](const TrianglePoints& points) {
    return cross(side_of_triangle(points, 1, &in_binary64), side_of_triangle(points, 2, &in_binary64));
  };
  const auto a = normal(s), b = normal(t);
  const BoundedNumber cosine = dot(a, b) / sqrt(dot(a, a) * dot(b, b));
  const double limit = std::cos(degrees * (std::numbers::pi / 180)), error = cosine.error + 3 * kLibraryError;
  if (cosine.value < limit - error) return true;
  if (cosine.value > limit + error) return false;
  return turns_by_more(s, t, degrees);
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
    return crease_ < 180 && separates(points_from(mesh_, fan[i]), points_from(mesh_, fan[(i + 1) % fan.size()]), crease_);
  }

  void set_normal(const std::vector<std::uint32_t>& group, NormalStages& stages) const {
    std::vector<TrianglePoints> triangles;
    for (const std::uint32_t h : group) triangles.push_back(points_from(mesh_, h));
    const auto [x, y, z] = normal_in_binary64(triangles);
    const auto count = static_cast<std::uint64_t>(x.has_value()) + y.has_value() + z.has_value();
    stages.binary64 += count;
    stages.intervals += 3 - count;
    const Normal normal = count == 3 ? Normal{*x, *y, *z} : normal_in_intervals(triangles);
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
