// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <functional>
#include <span>

#include "forceshade/meshes.h"
#include "rendering/half_edges.h"
#include "rendering/meshes/distances.h"
#include "rendering/meshes/join.h"
#include "rendering/meshes/predicates.h"
#include "rendering/meshes/readers.h"
#include "rendering/meshes/weld.h"
#include "text/joined.h"

namespace forceshade::mesh {
namespace {

constexpr std::size_t kNamed = 20;
constexpr std::uint32_t kBeyond = 0xFFFFFFFF;  // in place of a vertex that does not exist

// "dropped 3 faces without area: 4, 9, 12", of many only the first.
std::string sentence(const std::string& words, const std::vector<std::uint32_t>& numbers) {
  return words + ": " + joined(first_of(kNamed, numbers), ", ", in_digits) + (numbers.size() > kNamed ? ", ..." : "");
}

class Repair {
 public:
  explicit Repair(TriangleMesh mesh) : mesh_(std::move(mesh)), number_(mesh_.triangles.size()) {
    for (std::uint32_t i = 0; i < number_.size(); ++i) number_[i] = i;
  }

  Repaired run(std::optional<float> length) {
    weld();
    drop("with a vertex that does not exist", [&](const Triangle& t) {
      return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return v >= mesh_.vertices.size(); });
    });
    drop("with a vertex twice", [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    drop("without area", [&](const Triangle& t) {
      return !has_area({mesh_.vertices[t[0]], mesh_.vertices[t[1]], mesh_.vertices[t[2]]});
    });
    if (length) join(*length);
    drop_same();
    orient();
    return {std::move(mesh_), std::move(done_), std::move(moved_), std::move(split_)};
  }

 private:
  void weld() {
    Welder welder;
    std::vector<std::uint32_t> place(mesh_.vertices.size(), kBeyond);
    std::size_t valid = 0;
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      Vertex vertex{};
      bool is_valid = true;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto kept = coordinate(mesh_.vertices[v][i]);
        is_valid &= kept.has_value();
        vertex[i] = kept.value_or(0);
      }
      if (!is_valid) continue;
      ++valid;
      place[v] = welder.place_of(vertex);
      if (place[v] == first_.size()) first_.push_back(static_cast<std::uint32_t>(v));
    }
    const std::size_t count = mesh_.vertices.size();
    mesh_.vertices = welder.take();
    for (Triangle& t : mesh_.triangles)
      for (std::uint32_t& v : t) v = v < count ? place[v] : kBeyond;
    if (valid < count)
      done_.push_back("dropped " + std::to_string(count - valid) +
                      " vertices with a coordinate that is no number within 10000 mm");
    if (mesh_.vertices.size() < valid)
      done_.push_back("joined " + std::to_string(valid - mesh_.vertices.size()) +
                      " vertices to another with the same coordinates");
  }

  void join(float length) {
    const Join join = join_borders(mesh_, length, number_);
    for (std::uint32_t v = 0; v < join.onto.size(); ++v)
      if (const std::uint32_t onto = join.onto[v]; onto != v)
        moved_.push_back({first_[v], first_[onto], root(squared(side(mesh_.vertices[v], mesh_.vertices[onto])))});
    std::vector<std::uint32_t> number;
    for (const std::uint32_t i : join.of) number.push_back(number_[i]);
    for (const auto& [triangle, vertex, distance] : join.splits)
      split_.push_back({number_[triangle], first_[vertex], root(distance)});
    mesh_.triangles = join.triangles;
    number_ = std::move(number);
    const std::string within = " within " + shortest(length) + " mm";
    if (!moved_.empty()) {
      std::string words = "moved " + std::to_string(moved_.size()) + " vertices of borders onto another" + within + ": ";
      for (std::size_t i = 0; i < moved_.size() && i < kNamed; ++i)
        words += (i == 0 ? "" : ", ") + std::to_string(moved_[i].vertex) + " onto " + std::to_string(moved_[i].onto) + " by " +
                 shortest(static_cast<float>(moved_[i].distance)) + " mm";
      done_.push_back(moved_.size() > kNamed ? words + ", ..." : words);
    }
    if (split_.empty()) return;
    std::string words =
        "split faces at " + std::to_string(split_.size()) + " vertices of borders beside their edges" + within + ": ";
    for (std::size_t i = 0; i < split_.size() && i < kNamed; ++i)
      words += (i == 0 ? "face " : ", face ") + std::to_string(split_[i].triangle) + " at " + std::to_string(split_[i].vertex) +
               ", " + shortest(static_cast<float>(split_[i].distance)) + " mm from it";
    done_.push_back(split_.size() > kNamed ? words + ", ..." : words);
  }

  // The faces of which it is so go. `number_` keeps the numbers that the faces had.
  void drop(const std::string& words, const std::function<bool(const Triangle&)>& is_wrong) {
    std::vector<std::uint32_t> dropped;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (is_wrong(mesh_.triangles[i])) {
        dropped.push_back(number_[i]);
        continue;
      }
      mesh_.triangles[kept] = mesh_.triangles[i];
      number_[kept++] = number_[i];
    }
    mesh_.triangles.resize(kept);
    number_.resize(kept);
    if (!dropped.empty()) done_.push_back(sentence("dropped " + std::to_string(dropped.size()) + " faces " + words, dropped));
  }

  void drop_same() {
    std::vector<std::array<std::uint32_t, 4>> sorted;  // the vertices in order, the face
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      Triangle t = mesh_.triangles[i];
      std::sort(t.begin(), t.end());
      sorted.push_back({t[0], t[1], t[2], i});
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<bool> is_same(sorted.size(), false);
    for (std::size_t i = 1; i < sorted.size(); ++i)
      is_same[sorted[i][3]] = std::equal(sorted[i].begin(), sorted[i].begin() + 3, sorted[i - 1].begin());
    std::size_t at = 0;
    drop("with the vertices of a face before them", [&](const Triangle&) { return is_same[at++]; });
  }

  // Over edges with two faces, whatever their directions. Of the two ways to turn a part, it takes the one that turns fewer
  // faces.
  void orient() {
    std::vector<std::uint32_t> across(3 * mesh_.triangles.size(), kNoEdge);
    for_each_edge(mesh_, [&](std::span<const std::uint32_t> half_edges) {
      if (half_edges.size() != 2) return;
      across[half_edges[0]] = half_edges[1];
      across[half_edges[1]] = half_edges[0];
    });
    enum : char { unmet, kept, turned };
    std::vector<char> state(mesh_.triangles.size(), unmet);
    std::vector<std::uint32_t> next, turned_over;
    for (std::uint32_t first = 0; first < mesh_.triangles.size(); ++first) {
      if (state[first] != unmet) continue;
      state[first] = kept;
      next.assign(1, first);
      std::vector<std::uint32_t> part;
      bool is_possible = true;
      while (!next.empty()) {
        const std::uint32_t i = next.back();
        next.pop_back();
        part.push_back(i);
        for (std::uint32_t h = 3 * i; h < 3 * i + 3; ++h) {
          if (across[h] == kNoEdge) continue;
          const std::uint32_t other = across[h] / 3;
          const bool is_same_direction = start_of(mesh_, h) == start_of(mesh_, across[h]);
          const char expected = (state[i] == turned) == is_same_direction ? kept : turned;
          if (state[other] == unmet) {
            state[other] = expected;
            next.push_back(other);
          } else if (state[other] != expected) {
            is_possible = false;
          }
        }
      }
      const auto is_turned = [&](std::uint32_t i) { return state[i] == turned; };
      if (!is_possible) {
        done_.push_back("left the part of face " + std::to_string(number_[first]) + " as it is: it has only one side");
        for (const std::uint32_t i : part) state[i] = kept;
      } else if (2 * static_cast<std::size_t>(std::ranges::count_if(part, is_turned)) > part.size()) {
        for (const std::uint32_t i : part) state[i] = is_turned(i) ? kept : turned;
      }
    }
    for (std::uint32_t i = 0; i < mesh_.triangles.size(); ++i) {
      if (state[i] != turned) continue;
      std::swap(mesh_.triangles[i][1], mesh_.triangles[i][2]);
      turned_over.push_back(number_[i]);
    }
    if (!turned_over.empty())
      done_.push_back(sentence("turned " + std::to_string(turned_over.size()) + " faces over", turned_over));
  }

  TriangleMesh mesh_;
  std::vector<std::uint32_t> number_;  // of each face, which it had at first
  std::vector<std::uint32_t> first_;   // of each vertex, the first with its coordinates
  std::vector<std::string> done_;
  std::vector<Repaired::Moved> moved_;
  std::vector<Repaired::Split> split_;
};

}  // namespace

Repaired repair(TriangleMesh mesh, std::optional<float> join) {
  return Repair(std::move(mesh)).run(join);
}

}  // namespace forceshade::mesh
