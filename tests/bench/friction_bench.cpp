// SPDX-License-Identifier: BSD-3-Clause
// The god-object's time for a tick with Coulomb friction, beside that of the same tick without: forceshade_friction_bench
// [MOST_TRIANGLES [LEAST_TRIANGLES]].

#include <cmath>
#include <memory>
#include <numbers>

#include "fast/meshes/session.h"
#include "forceshade/meshes.h"
#include "tests/bench/mesh_workloads.h"
#include "tests/bench/timing.h"

namespace forceshade::bench {
namespace {

using Path = std::vector<std::array<float, 3>>;
constexpr std::size_t kRun = 4000;  // ticks around one place

struct Stroke {
  const char* name;
  Path approach, contact;
};
// To and fro by 0.2 mm at places of the workload's path in contact, so that friction holds the god-object.
Stroke holding(const MeshWorkload& workload) {
  Stroke stroke{"held", workload.approach, {}};
  for (std::size_t i = 0; i < workload.contact.size(); ++i) {
    auto p = workload.contact[i / kRun * kRun];
    const double phase = 2 * std::numbers::pi * static_cast<double>(i % kRun) / 100;
    p[0] += static_cast<float>(0.1 * std::sin(phase));
    p[1] += static_cast<float>(0.1 * std::sin(1.7 * phase));
    stroke.contact.push_back(p);
  }
  return stroke;
}

// The median of a tick, by one reading of the clock for 16 of them, each of which waits until the one before is done; and the
// time that 999 of 1000 ticks do not exceed, by a reading for each. us
struct Cost {
  double median = HUGE_VAL, most_of_1000 = HUGE_VAL;
};
struct Case {
  mesh::Contact contact;
  mesh::Shading shading;
  Cost cost;
  std::size_t in_contact = 0, slipping = 0, moves = 0, allocations = 0;
};

void wait_until_done() {
#if defined(__x86_64__)
  __builtin_ia32_lfence();
#endif
}

void measure(const Stroke& stroke, const std::shared_ptr<const fast::Mesh>& mesh, Case& one, const Scale& scale) {
  constexpr std::size_t kTogether = 16;
  const auto open = [&] {
    fast::MeshSession session(mesh, static_cast<float>(kMeshStiffness), one.shading, one.contact);
    for (const auto& p : stroke.approach) session.tick(p);
    return session;
  };
  std::vector<double> times;
  fast::MeshSession session = open();
  const Times each = bench::measure(stroke.contact, scale, times, [&](const auto& p) { keep(session.tick(p)); });
  session = open();
  std::vector<double> groups;
  for (std::size_t i = 0; i + kTogether <= stroke.contact.size(); i += kTogether)
    groups.push_back(time_of(scale,
                             [&] {
                               for (std::size_t k = 0; k < kTogether; ++k) {
                                 keep(session.tick(stroke.contact[i + k]));
                                 wait_until_done();
                               }
                             }) /
                     kTogether);
  one.cost.median = std::min(one.cost.median, summary(groups, 0).median);
  one.cost.most_of_1000 = std::min(one.cost.most_of_1000, each.most_of_1000);
  one.allocations += each.allocations;
}

void count(const Stroke& stroke, const std::shared_ptr<const fast::Mesh>& mesh, Case& one) {
  fast::MeshSession session(mesh, static_cast<float>(kMeshStiffness), one.shading, one.contact);
  for (const auto& p : stroke.approach) session.tick(p);
  for (const auto& p : stroke.contact) {
    const mesh::Tick tick = session.tick(p);
    one.in_contact += tick.status == Status::contact;
    one.slipping += tick.after.is_slipping;
    one.moves += tick.moves;
  }
}

void run(const Stroke& stroke, const std::shared_ptr<const fast::Mesh>& mesh, mesh::Shading shading, const Scale& scale) {
  Case cases[]{{mesh::Contact::direct, shading, {}}, {mesh::Contact::friction, shading, {}}};
  for (int pass = 0; pass < 2 * kPasses; ++pass)
    for (Case& one : cases) measure(stroke, mesh, one, scale);
  for (Case& one : cases) count(stroke, mesh, one);
  const auto& [without, with] = cases;
  const auto ticks = static_cast<double>(stroke.contact.size());
  std::printf(
      "  %-6s%-9s p50 %.3f, with friction %.3f us: %.2f times; p99.9 %.3f, %.3f us; moves a tick %.2f, %.2f; in contact "
      "%.0f %%, slipping %.0f %%; %zu allocations\n",
      stroke.name, shading == mesh::Shading::none ? "" : ", shaded", without.cost.median, with.cost.median,
      with.cost.median / without.cost.median, without.cost.most_of_1000, with.cost.most_of_1000,
      static_cast<double>(without.moves) / ticks, static_cast<double>(with.moves) / ticks,
      100 * static_cast<double>(with.in_contact) / ticks, 100 * static_cast<double>(with.slipping) / ticks,
      without.allocations + with.allocations);
}

void run(const MeshWorkload& workload, const Scale& scale) {
  MeshRendering rendering = unshaded_rendering(workload);
  rendering.normals = mesh::corner_normals(rendering.checked).normals;
  rendering.shading = mesh::Shading::vertex_scheme;
  rendering.contact = mesh::Contact::friction;
  const Stroke strokes[]{{"stroke", workload.approach, workload.contact}, holding(workload)};
  for (const auto& [static_friction, dynamic_friction] : {std::array{0.0F, 0.0F}, {0.6F, 0.3F}}) {
    rendering.materials.list = {{{}, static_friction, dynamic_friction}};
    const auto mesh = std::make_shared<const fast::Mesh>(value_of(fast::Mesh::build(rendering), workload));
    std::printf("%s: %zu triangles, coefficients %.1f and %.1f\n", workload.name.c_str(), workload.mesh.triangles.size(),
                static_cast<double>(static_friction), static_cast<double>(dynamic_friction));
    for (const Stroke& stroke : strokes) {
      if (static_friction == 0 && &stroke != strokes) continue;
      run(stroke, mesh, mesh::Shading::none, scale);
      if (static_friction > 0) run(stroke, mesh, mesh::Shading::vertex_scheme, scale);
    }
  }
}

}  // namespace
}  // namespace forceshade::bench

int main(int argc, char** argv) {
  using namespace forceshade::bench;
  const double most = argc > 1 ? std::atof(argv[1]) : 1.1e6, fewest = argc > 2 ? std::atof(argv[2]) : 0;
  constexpr std::size_t kContact = 200000;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const Scale clock = scale();
  const auto is_in_range = [&](double triangles) { return triangles >= fewest && triangles <= most; };
  for (const int f : {7, 71, 707})
    if (is_in_range(20.0 * f * f)) run(sphere_workload(f, kContact, 0), clock);
  for (const int n : {22, 224, 2236})
    if (is_in_range(2.0 * n * n)) run(bump_workload(n, kContact, 0), clock);
}
