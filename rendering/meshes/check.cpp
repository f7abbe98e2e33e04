// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>
#include <thread>
#include <tuple>

#include "forceshade/meshes.h"
#include "rendering/half_edges.h"
#include "rendering/meshes/box_tree.h"
#include "rendering/meshes/findings.h"
#include "rendering/meshes/pairs.h"
#include "rendering/meshes/predicates.h"
#include "rendering/meshes/readers.h"
#include "text/joined.h"

namespace forceshade::mesh {
namespace {

bool is_before(const Finding& a, const Finding& b) {
  return std::tie(a.fault, a.triangles, a.vertices) < std::tie(b.fault, b.triangles, b.vertices);
}

// Keeps the first findings of each fault, in whatever order they come.
class Collector {
 public:
  void add(Fault fault, std::vector<std::uint32_t> triangles, std::vector<std::uint32_t> vertices) {
    const auto of = static_cast<std::size_t>(fault);
    ++counts_[of];
    kept_[of].push_back({fault, std::move(triangles), std::move(vertices)});
    if (kept_[of].size() == 2 * Findings::kListed) shorten(kept_[of]);
  }
  void add(const Collector& other) {
    for (std::size_t of = 0; of < kFaults; ++of) {
      counts_[of] += other.counts_[of];
      kept_[of].insert(kept_[of].end(), other.kept_[of].begin(), other.kept_[of].end());
    }
  }
  bool has(Fault fault) const { return counts_[static_cast<std::size_t>(fault)] > 0; }

  Findings take() {
    Findings findings;
    findings.counts = counts_;
    for (std::vector<Finding>& kept : kept_) {
      shorten(kept);
      findings.listed.insert(findings.listed.end(), kept.begin(), kept.end());
    }
    return findings;
  }

 private:
  static void shorten(std::vector<Finding>& kept) {
    std::sort(kept.begin(), kept.end(), is_before);
    if (kept.size() > Findings::kListed) kept.resize(Findings::kListed);
  }

  std::array<std::uint64_t, kFaults> counts_{};
  std::array<std::vector<Finding>, kFaults> kept_;
};

// The first few of many triangles.
std::vector<std::uint32_t> some(std::vector<std::uint32_t> triangles) {
  constexpr std::size_t kMostNamed = 8;
  std::sort(triangles.begin(), triangles.end());
  if (triangles.size() > kMostNamed) triangles.resize(kMostNamed);
  return triangles;
}

TrianglePoints points_of(const TriangleMesh& mesh, const Triangle& t) {
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

void quantise(TriangleMesh& mesh, Collector& found) {
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    for (float& x : mesh.vertices[v]) {
      const auto kept = coordinate(x);
      if (!kept) {
        found.add(Fault::coordinate, {}, {v});
        break;
      }
      x = *kept;
    }
}

void check_triangles(const TriangleMesh& mesh, Collector& found) {
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const auto wrong = std::find_if(t.begin(), t.end(), [&](std::uint32_t v) { return v >= mesh.vertices.size(); });
    if (wrong != t.end()) {
      found.add(Fault::index, {i}, {*wrong});
    } else if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
      found.add(Fault::vertex_twice, {i}, {t[0] == t[1] || t[0] == t[2] ? t[0] : t[1]});
    } else if (!found.has(Fault::coordinate) && !has_area(points_of(mesh, t))) {
      found.add(Fault::no_area, {i}, {t[0], t[1], t[2]});
    }
  }
}

// Two triangles with the same vertices are reported at the edge of their two lower ones.
void check_same_vertices(const TriangleMesh& mesh, std::span<const std::uint32_t> half_edges, Collector& found) {
  const std::uint32_t higher = std::max(start_of(mesh, half_edges[0]), end_of(mesh, half_edges[0]));
  const std::uint32_t lower = std::min(start_of(mesh, half_edges[0]), end_of(mesh, half_edges[0]));
  std::vector<std::array<std::uint32_t, 2>> thirds;  // third vertex, triangle
  for (const std::uint32_t h : half_edges)
    if (const std::uint32_t third = start_of(mesh, previous_in_triangle(h)); third > higher) thirds.push_back({third, h / 3});
  std::sort(thirds.begin(), thirds.end());
  for (std::size_t i = 1; i < thirds.size(); ++i)
    if (thirds[i][0] == thirds[i - 1][0])
      found.add(Fault::same_vertices, {thirds[i - 1][1], thirds[i][1]}, {lower, higher, thirds[i][0]});
}

void check_edges(const TriangleMesh& mesh, std::vector<std::uint32_t>& opposite, Collector& found) {
  for_each_edge(mesh, [&](std::span<const std::uint32_t> half_edges) {
    if (half_edges.size() == 1) return;
    check_same_vertices(mesh, half_edges, found);
    const std::vector<std::uint32_t> ends{std::min(start_of(mesh, half_edges[0]), end_of(mesh, half_edges[0])),
                                          std::max(start_of(mesh, half_edges[0]), end_of(mesh, half_edges[0]))};
    std::vector<std::uint32_t> triangles;
    if (half_edges.size() > 2) {
      for (const std::uint32_t h : half_edges) triangles.push_back(h / 3);
      found.add(Fault::many_at_edge, some(std::move(triangles)), ends);
    } else if (start_of(mesh, half_edges[0]) == start_of(mesh, half_edges[1])) {
      found.add(Fault::same_direction, some({half_edges[0] / 3, half_edges[1] / 3}), ends);
    } else {
      opposite[half_edges[0]] = half_edges[1];
      opposite[half_edges[1]] = half_edges[0];
    }
  });
}

// The fan of a vertex's first corner has to be that of all its corners.
void check_fans(const TriangleMesh& mesh, const std::vector<std::uint32_t>& opposite, Collector& found) {
  std::vector<std::uint32_t> first(mesh.vertices.size(), kNoEdge);
  std::vector<bool> is_in_fan(opposite.size(), false);
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    const std::uint32_t v = start_of(mesh, h);
    if (first[v] != kNoEdge) continue;
    first[v] = h;
    walk_around(opposite, h, [&](std::uint32_t at) { is_in_fan[at] = true; });
  }
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    const std::uint32_t v = start_of(mesh, h);
    if (is_in_fan[h] || first[v] == kNoEdge) continue;
    found.add(Fault::several_fans, {first[v] / 3, h / 3}, {v});
    first[v] = kNoEdge;  // once is enough
  }
}

void check_pair(const TriangleMesh& mesh, std::uint32_t i, std::uint32_t j, Collector& found) {
  Triangle s = mesh.triangles[i], t = mesh.triangles[j];
  const std::size_t shared = shared_first(s, t);
  const TrianglePoints of_s = points_of(mesh, s), of_t = points_of(mesh, t);
  const bool is_wrong = shared == 0   ? meet(of_s, of_t)
                        : shared == 1 ? meet_beside_corner(of_s, of_t)
                                      : shared == 2 && meet_beside_edge(of_s, of_t);
  if (!is_wrong) return;
  std::vector<std::uint32_t> common(s.begin(), s.begin() + static_cast<std::ptrdiff_t>(shared));
  std::sort(common.begin(), common.end());
  found.add(Fault::meeting, {i, j}, std::move(common));
}

void check_meetings(const TriangleMesh& mesh, const Monitor& monitor, Collector& found) {
  const BoxTree tree(mesh);
  const std::uint64_t most = most_pairs(mesh.triangles.size());
  std::atomic<std::size_t> task = 0;
  std::atomic<std::uint64_t> pairs = 0;
  std::mutex mutex;
  // report: of the tasks that are done, after each task and after many pairs, because one task may take minutes where many
  // triangles meet at a vertex; throws where the work is to stop.
  const auto work = [&](const std::function<void(std::size_t)>& report) {
    Collector of_thread;
    std::uint64_t uncounted = 0;
    bool goes_on = true;
    std::size_t begun = 0;
    const auto pair = [&](std::uint32_t i, std::uint32_t j) {
      check_pair(mesh, i, j, of_thread);
      constexpr std::uint64_t kMany = std::uint64_t{1} << 16;
      if (++uncounted < kMany) return true;
      uncounted = 0;
      report(begun);
      return goes_on = (pairs += kMany) <= most;
    };
    for (std::size_t i = task++; goes_on && i < tree.tasks(); i = task++) {
      begun = i;
      tree.run(i, pair);
      report(i + 1);
    }
    const std::lock_guard lock(mutex);
    found.add(of_thread);
  };
  std::vector<std::jthread> others;
  const bool is_small = mesh.triangles.size() < 10000;
  for (unsigned i = 1; !is_small && i < std::min(std::thread::hardware_concurrency(), 8U); ++i)
    others.emplace_back([&] { work([](std::size_t) {}); });
  try {
    double share = 0;  // of the tasks, or of the pairs after which it is given up
    work([&](std::size_t done) {
      share = std::max({share, static_cast<double>(done) / static_cast<double>(tree.tasks()),
                        std::min(static_cast<double>(pairs) / static_cast<double>(most), 1.0)});
      monitor.at(share);
    });
  } catch (const Interrupted&) {
    task = tree.tasks();
    pairs = most;  // the other threads end with the pairs that they are at
    throw;
  }
  others.clear();
  monitor.at(1);
  if (pairs > most) found.add(Fault::undecided, {}, {});
}

// All but the meetings.
void check_joints(TriangleMesh& mesh, Collector& found) {
  if (mesh.triangles.empty() || mesh.triangles.size() > kMost || mesh.vertices.size() > kMost)
    return found.add(Fault::empty, {}, {});
  quantise(mesh, found);
  check_triangles(mesh, found);
  if (found.has(Fault::index) || found.has(Fault::vertex_twice)) return;
  std::vector<std::uint32_t> opposite(3 * mesh.triangles.size(), kNoEdge);
  check_edges(mesh, opposite, found);
  if (!found.has(Fault::many_at_edge) && !found.has(Fault::same_direction)) check_fans(mesh, opposite, found);
}

constexpr auto listed = [](const auto& numbers) { return joined(numbers, ", ", in_digits, " and "); };

// The place of a finding's triangles in the file: "line 12: " or "lines 12 and 15: ".
std::string place_of(const Finding& finding, std::span<const std::uint64_t> lines) {
  if (lines.empty() || finding.triangles.empty()) return "";
  std::vector<std::uint64_t> its;
  for (const std::uint32_t triangle : finding.triangles)
    if (std::ranges::find(its, lines[triangle]) == its.end()) its.push_back(lines[triangle]);
  return (its.size() == 1 ? "line " : "lines ") + listed(its) + ": ";
}

}  // namespace

std::string words_of(const Finding& finding) {
  const std::string faces = listed(finding.triangles), vertices = listed(finding.vertices);
  switch (finding.fault) {
    case Fault::coordinate: return "vertex " + vertices + " has a coordinate that is no number within 10000 mm";
    case Fault::index: return "face " + faces + " has vertex " + vertices + ", which is not there";
    case Fault::empty: return "there is no face, or more than " + std::to_string(kMost) + " faces or vertices";
    case Fault::vertex_twice: return "face " + faces + " has vertex " + vertices + " twice";
    case Fault::no_area: return "face " + faces + " has no area: its vertices " + vertices + " lie on a line";
    case Fault::same_vertices: return "faces " + faces + " have the same vertices " + vertices;
    case Fault::many_at_edge: return "the edge of vertices " + vertices + " has more than two faces: " + faces;
    case Fault::same_direction:
      return "faces " + faces + " run along their edge, of vertices " + vertices +
             ", in the same direction: one of them is turned over";
    case Fault::several_fans:
      return "faces " + faces + " meet at vertex " + vertices +
             ", but no edges there lead from one to the other: expected one fan";
    case Fault::meeting:
      if (finding.vertices.empty()) return "faces " + faces + " meet, but have no vertex in common";
      if (finding.vertices.size() == 1)
        return "faces " + faces + " have vertex " + vertices + " in common, but meet elsewhere, too";
      return "faces " + faces + " are folded onto each other at their edge, of vertices " + vertices;
    case Fault::undecided: return "it cannot be decided in reasonable time whether faces meet: too many are near each other";
  }
  return "";
}

std::string words_of(const Finding& finding, std::span<const std::uint64_t> lines) {
  return place_of(finding, lines) + words_of(finding);
}

std::string words_of(const Findings& findings, const std::function<std::string(const Finding&)>& words) {
  const std::vector<Finding>& listed = findings.listed;
  std::string text;
  for (std::size_t i = 0; i < listed.size(); ++i) {
    text += words(listed[i]) + '\n';
    const Fault fault = listed[i].fault;
    const std::uint64_t count = findings.counts[static_cast<std::size_t>(fault)];
    if ((i + 1 == listed.size() || listed[i + 1].fault != fault) && count > Findings::kListed)
      text += "and " + std::to_string(count - Findings::kListed) + " more of this kind\n";
  }
  return text;
}

std::string Findings::words(std::span<const std::uint64_t> lines) const {
  return words_of(*this, [&](const Finding& finding) { return words_of(finding, lines); });
}

std::variant<JoinedMesh, Findings> check_joints(TriangleMesh mesh) {
  Collector found;
  check_joints(mesh, found);
  if (Findings findings = found.take(); !findings.empty()) return findings;
  return JoinedMesh(std::move(mesh));
}

std::variant<CheckedMesh, Findings> check(TriangleMesh mesh, const Monitor& monitor) {
  Collector found;
  check_joints(mesh, found);
  const auto is_found = [&](Fault fault) { return found.has(fault); };
  if (std::ranges::none_of(std::array{Fault::empty, Fault::index, Fault::vertex_twice, Fault::coordinate, Fault::no_area},
                           is_found))
    check_meetings(mesh, monitor, found);
  if (Findings findings = found.take(); !findings.empty()) return findings;
  return CheckedMesh(std::move(mesh), true);
}

std::variant<CheckedMesh, Findings> check_any(TriangleMesh mesh, const Monitor& monitor) {
  std::variant<CheckedMesh, Findings> checked = check(mesh, monitor);
  const auto* findings = std::get_if<Findings>(&checked);
  if (findings == nullptr) return checked;
  const auto is_found = [&](Fault fault) { return findings->counts[static_cast<std::size_t>(fault)] > 0; };
  if (std::ranges::any_of(std::array{Fault::empty, Fault::index, Fault::coordinate}, is_found)) return checked;
  quantise(mesh);
  if (std::ranges::none_of(mesh.triangles, [&](const Triangle& triangle) { return has_area(points_of(mesh, triangle)); }))
    return checked;
  return CheckedMesh(std::move(mesh), false);
}

}  // namespace forceshade::mesh
