// SPDX-License-Identifier: BSD-3-Clause
// The god-object's time for a tick, beside that of a naive binary32 one on the same path: forceshade_mesh_bench
// [MOST_TRIANGLES [LEAST_TRIANGLES]].

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <variant>

#include "fast/meshes/session.h"
#include "forceshade/meshes.h"
#include "rendering/meshes/make.h"
#include "rendering/meshes/texture.h"
#include "tests/bench/mesh_workloads.h"
#include "tests/bench/naive_mesh.h"
#include "tests/bench/timing.h"

namespace forceshade::bench {
namespace {

// Notes how many decisions each stage has taken.
struct CountedStages {
  static constexpr bool kFilter = true;
  int* in_binary64;
  int* in_integers;
  bool sure(bool is_proved) const noexcept {
    *in_binary64 += is_proved;
    return is_proved;
  }
  void note(fast::Stage) const noexcept { ++*in_integers; }
};

constexpr auto kStiffness = static_cast<float>(kMeshStiffness);

struct Rendering {
  std::shared_ptr<const fast::Mesh> mesh;
  mesh::Shading shading = mesh::Shading::none;
  mesh::Contact contact = mesh::kUsualContact;

  // At the beginning of the path in contact.
  fast::MeshSession session(const MeshWorkload& workload) const {
    fast::MeshSession session(mesh, kStiffness, shading, contact);
    for (const auto& p : workload.approach) session.tick(p);
    return session;
  }
};

double percentile(std::vector<double> times, double part) {
  std::ranges::sort(times);
  return times[static_cast<std::size_t>(part * static_cast<double>(times.size() - 1))];
}

// The times of the ticks in contact, without look_ahead() and after it. Every pass goes along the same path; the least of each
// percentile counts, since other programs disturb some of them. shortest: of each tick, over the passes without.
void run_contact(const MeshWorkload& workload, const Rendering& rendering, const Scale& scale, std::vector<double>& shortest) {
  Times at_once = kNone, after_look = kNone, look = kNone;
  std::vector<double> times, looks;
  looks.reserve(workload.contact.size());
  shortest.assign(workload.contact.size(), HUGE_VAL);
  for (int pass = 0; pass < kPasses; ++pass) {
    fast::MeshSession session = rendering.session(workload);
    at_once = least(at_once, measure(workload.contact, scale, times, [&](const auto& p) { keep(session.tick(p)); }));
    for (std::size_t i = 0; i < times.size(); ++i) shortest[i] = std::min(shortest[i], times[i]);

    fast::MeshSession other = rendering.session(workload);
    times.clear();
    looks.clear();
    for (const auto& p : workload.contact) {
      looks.push_back(time_of(scale, [&] { other.look_ahead(); }));
      times.push_back(time_of(scale, [&] { keep(other.tick(p)); }));
    }
    after_look = least(after_look, summary(times, 0));
    look = least(look, summary(looks, 0));
  }
  print("exact, contact", at_once);
  print("exact, after look_ahead()", after_look);
  print("look_ahead() itself", look);
}

// The same ticks where nothing has to come from memory: pieces of the path, each gone through several times.
void run_in_caches(const MeshWorkload& workload, const Rendering& rendering, const Scale& scale) {
  constexpr std::size_t kPieces = 20, kLength = 1000;
  const std::size_t apart = workload.contact.size() / kPieces;
  fast::MeshSession session = rendering.session(workload);
  std::vector<double> all;
  double mean = 0;  // us, by one reading of the clock for a piece
  for (std::size_t piece = 0; piece < kPieces; ++piece) {
    const std::size_t begin = piece * apart;
    const mesh::GodObject start = session.state();
    std::vector<double> shortest(kLength, HUGE_VAL);
    for (int pass = 0; pass <= kPasses; ++pass) {
      session.resume(start);
      for (std::size_t i = 0; i < kLength; ++i) {
        const double time = time_of(scale, [&] { keep(session.tick(workload.contact[begin + i])); });
        if (pass > 0) shortest[i] = std::min(shortest[i], time);
      }
    }
    double whole = HUGE_VAL;
    for (int pass = 0; pass < kPasses; ++pass) {
      session.resume(start);
      whole = std::min(whole, time_of(scale, [&] {
                         for (std::size_t i = 0; i < kLength; ++i) keep(session.tick(workload.contact[begin + i]));
                       }));
    }
    mean += whole / kLength / kPieces;
    all.insert(all.end(), shortest.begin(), shortest.end());
    for (std::size_t i = kLength; i < apart; ++i) session.tick(workload.contact[begin + i]);
  }
  print("exact, all in the caches", summary(all, 0));
  std::printf("  %-28s mean %.3f us a tick, the clock being read once for %zu ticks\n", "", mean, kLength);
}

// As a loop of 1 kHz meets it when other programs have used the caches since the last tick.
void run_cold(const MeshWorkload& workload, const Rendering& rendering, const Scale& scale, Memory& memory) {
  for (const bool looks_ahead : {false, true}) {
    fast::MeshSession session = rendering.session(workload);
    const std::size_t every = workload.contact.size() / 300;
    std::vector<double> cold;
    for (std::size_t i = 0; i < workload.contact.size(); ++i) {
      if (i % every != every - 1) {
        session.tick(workload.contact[i]);
        continue;
      }
      memory.flush_caches();
      const std::array<float, 3> position = workload.contact[i];  // a loop has just read it
      const auto step = [&] { keep(session.tick(position)); };
      keep(position);
      if (looks_ahead) session.look_ahead();
      cold.push_back(time_of(scale, step));
    }
    std::printf("  %-28s p50 %6.3f  p99   %6.3f us\n", looks_ahead ? "cold caches, look_ahead()" : "cold caches",
                percentile(cold, 0.5), percentile(cold, 0.99));
  }
}

void run_exact(const MeshWorkload& workload, const Rendering& rendering, const Scale& scale) {
  std::vector<double> shortest, times;
  run_contact(workload, rendering, scale, shortest);
  run_in_caches(workload, rendering, scale);
  Memory memory(rendering.mesh->faces());
  run_cold(workload, rendering, scale, memory);

  std::vector<mesh::GodObject> states;  // before each tick in contact
  std::vector<double> entered;          // triangles, by each tick
  std::size_t touching = 0;
  fast::MeshSession session = rendering.session(workload);
  for (const auto& p : workload.contact) {
    states.push_back(session.state());
    const mesh::Tick tick = session.tick(p);
    touching += tick.status == Status::contact;
    entered.push_back(tick.moves > 0 ? tick.moves - 1.0 : 0.0);
  }
  const double mean = std::accumulate(entered.begin(), entered.end(), 0.0) / static_cast<double>(entered.size());
  std::printf("  %zu of %zu ticks in contact, %.2f moves a tick\n", touching, entered.size(), 1 + mean);
  const double latency = memory.latency(scale), usual = percentile(entered, 0.5), most = percentile(entered, 0.999);
  std::printf(
      "  a load from memory %.3f us; a tick goes on to %.0f further triangles (p99.9: %.0f); loaded one after another: %.3f us "
      "(%.3f)\n",
      latency, usual, most, usual * latency, most * latency);

  Times free = kNone;
  for (int pass = 0; pass < kPasses; ++pass) {
    session.tick(workload.free.front());
    free = least(free, measure(workload.free, scale, times, [&](const auto& p) { keep(session.tick(p)); }));
  }
  print("exact, free", free);

  // The tick that took longest even in its shortest pass; not one of the first, which find other caches than the rest.
  constexpr std::ptrdiff_t kFirst = 100;
  const auto worst = static_cast<std::size_t>(std::max_element(shortest.begin() + kFirst, shortest.end()) - shortest.begin());
  int in_binary64 = 0, in_integers = 0;
  fast::Arrival arrival{grid_point_of(*rendering.mesh, states[worst]), fast::RestKind::none, 0, true};
  mesh::Tick tick;
  fast::advance(*rendering.mesh, arrival, fast::quantised(workload.contact[worst]), kStiffness, rendering.shading,
                CountedStages{&in_binary64, &in_integers}, tick);
  std::printf(
      "  the longest tick, in its shortest pass: tick %zu, %.3f us, %d moves, %d decisions in binary64, %d in integers, "
      "from %s to %s\n",
      worst, shortest[worst], int{tick.moves}, in_binary64, in_integers,
      mesh::kPlaceNames[static_cast<std::size_t>(states[worst].place)].data(),
      mesh::kPlaceNames[static_cast<std::size_t>(arrival.grid_point.place)].data());
}

void run_naive(const MeshWorkload& workload, const Scale& scale, const mesh::CornerNormals& normals = {}) {
  NaiveGodObject naive(workload.mesh, kStiffness, normals);
  const auto step = [&](const std::array<float, 3>& p) { keep(naive.step(Eigen::Vector3f(p.data()))); };
  Times contact = kNone, free = kNone;
  std::vector<double> times;
  for (int pass = 0; pass < kPasses; ++pass) {
    for (const auto& p : workload.approach) step(p);
    contact = least(contact, measure(workload.contact, scale, times, step));
    step(workload.free.front());
    free = least(free, measure(workload.free, scale, times, step));
  }
  print(normals.empty() ? "naive, contact" : "naive, vertex shading", contact);
  if (normals.empty()) print("naive, free", free);
}

// A B-spline of 1024 x 1024 samples over the mesh, seen from above, with slopes up to about one.
mesh::Texture texture_of(const mesh::CheckedMesh& checked) {
  height::Grid grid{1024, 1024, 0.1F, height::Edge::clamp, height::Interpolant::cubic_spline, {}};
  std::mt19937 random(1);
  std::uniform_real_distribution<float> uniform(-0.05F, 0.05F);
  for (std::uint32_t i = 0; i < grid.columns * grid.rows; ++i) grid.values.push_back(uniform(random));
  return {mesh::corner_textures(checked, mesh::texture_from_above(checked.mesh())),
          {{{std::make_shared<const height::Grid>(std::move(grid))}}}};
}

// Contact with the interpolated normal, and with a texture too where the mesh can be seen whole from above.
void run_shaded(const MeshWorkload& workload, bool is_seen_from_above, const Scale& scale) {
  auto check = mesh::check(workload.mesh);
  const auto* checked = std::get_if<mesh::CheckedMesh>(&check);
  if (checked == nullptr) return;
  const mesh::CornerNormals normals = mesh::corner_normals(*checked).normals;
  const mesh::Texture texture = is_seen_from_above ? texture_of(*checked) : mesh::Texture();
  const mesh::Shading most = is_seen_from_above ? mesh::Shading::texture_scheme : mesh::Shading::vertex_scheme;
  const Rendering rendering{std::make_shared<const fast::Mesh>(
      value_of(fast::Mesh::build({*checked, normals, mesh::Sides::front, most, kStiffness, texture}), workload))};
  for (const mesh::Shading shading : {mesh::Shading::vertex_scheme, mesh::Shading::texture_scheme}) {
    if (shading == mesh::Shading::texture_scheme && !is_seen_from_above) continue;
    Times contact = kNone;
    std::vector<double> times;
    for (int pass = 0; pass < kPasses; ++pass) {
      fast::MeshSession session = Rendering{rendering.mesh, shading}.session(workload);
      contact = least(contact, measure(workload.contact, scale, times, [&](const auto& p) { keep(session.tick(p)); }));
    }
    print(shading == mesh::Shading::vertex_scheme ? "exact, vertex shading" : "exact, texture shading", contact);
  }
  run_naive(workload, scale, normals);
}

void run(const MeshWorkload& workload, const Scale& scale) {
  double seconds = HUGE_VAL;
  Rendering rendering;
  const MeshRendering unshaded = unshaded_rendering(workload);
  for (int i = 0; i < 3; ++i) {
    const auto start = Clock::now();
    auto built = fast::Mesh::build(unshaded);
    seconds = std::min(seconds, seconds_since(start));
    rendering.mesh = std::make_shared<const fast::Mesh>(value_of(std::move(built), workload));
  }
  const auto triangles = static_cast<double>(workload.mesh.triangles.size());
  std::printf("%s: %.0f triangles, built in %.3f s, %.1f bytes a triangle\n", workload.name.c_str(), triangles, seconds,
              static_cast<double>(rendering.mesh->bytes()) / triangles);
  run_exact(workload, rendering, scale);
  run_naive(workload, scale);
}

}  // namespace
}  // namespace forceshade::bench

int main(int argc, char** argv) {
  using namespace forceshade::bench;
  const double most = argc > 1 ? std::atof(argv[1]) : 1.1e6, fewest = argc > 2 ? std::atof(argv[2]) : 0;
  constexpr std::size_t kContact = 200000, kFree = 20000;
  constexpr int kShadedSphere = 71, kShadedBump = 224;  // 10^5 triangles
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const Scale clock = scale();
  const auto is_in_range = [&](double triangles) { return triangles >= fewest && triangles <= most; };
  for (const int f : {7, 22, 71, 224, 707}) {
    if (!is_in_range(20.0 * f * f)) continue;
    const MeshWorkload workload = sphere_workload(f, kContact, kFree);
    run(workload, clock);
    if (f == kShadedSphere) run_shaded(workload, false, clock);
  }
  for (const int n : {22, 71, 224, 707, 2236}) {
    if (!is_in_range(2.0 * n * n)) continue;
    const MeshWorkload workload = bump_workload(n, kContact, kFree);
    run(workload, clock);
    if (n == kShadedBump) run_shaded(workload, true, clock);
  }
}
