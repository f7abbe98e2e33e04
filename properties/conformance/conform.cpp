// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/conform.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "files/csv.h"
#include "forceshade/bad_input.h"
#include "properties/conformance/invariants/all.h"
#include "properties/conformance/scene.h"
#include "properties/conformance/timing.h"

namespace forceshade::conformance {
namespace {

constexpr int kMostTries = 2000;               // of simpler paths
constexpr std::size_t kMostTouched = 200'000;  // triangles
constexpr int kMostJudgedTriangles = 500;      // of those whose force is not this program's own
constexpr std::size_t kTimedPath = 500;        // positions

bool is_beyond(const std::optional<Judged>& judged) {
  return judged && !judged->is_within;
}

class Run {
 public:
  Run(const Description& description, const OpenRenderer& open, const ConformOptions& options, const Monitor& monitor)
      : description_(description),
        open_(open),
        options_(options),
        monitor_(monitor),
        subject_(properties::subject_of(description)) {}

  Conformance run() {
    found_.identity = subject_->identity();
    try {
      renderer_ = std::make_unique<SceneRenderer>(opened_on(description_));
      found_.hello = renderer_->hello();
      if (found_.hello.refusal) return found_;
      if (found_.hello.claims_definition) {
        expect_meaning_of_tolerance();
        compare();
        shorten();
      }
      look_at_invariants();
      renderer_->say_goodbye();
    } catch (const RendererFailed& failure) {
      found_.failure = failure.what();
    }
    return found_;
  }

 private:
  SceneRenderer opened_on(const Description& description) const {
    const bool is_this = &description == &description_;
    const Identity identity = is_this ? subject_->identity() : properties::subject_of(description)->identity();
    return {open_(scene_of(description, identity)), description.stiffness()};
  }

  // Answers in other units are rounded once more when they are made forces in N.
  void expect_meaning_of_tolerance() const {
    const Hello& its = found_.hello;
    const bool is_force = its.answer == Answer::force && its.newtons == 1;
    if (is_force || options_.tolerance.unit != Unit::ulp || options_.tolerance.value >= 1) return;
    throw files::BadInput(
        "--tolerance: expected at least 1 ulp, or N or %, for a renderer whose answers are no forces in N, since these are "
        "rounded when they are made such");
  }

  void compare() {
    Judge judge(subject_, options_.tolerance);
    const auto positions = subject_->positions(options_.seed);
    for (std::uint64_t done = 0; done < options_.points;) {
      monitor_.at(0.9 * static_cast<double>(done) / static_cast<double>(options_.points));
      const std::uint64_t of_this_path = std::min(kPathLength - done % kPathLength, options_.points - done);
      const bool is_reset = done % kPathLength == 0;
      Path batch;
      std::vector<std::string_view> aims;
      while (batch.size() < std::min<std::uint64_t>(SceneRenderer::kBatch, of_this_path)) {
        const properties::Aimed aimed = positions->next();
        const Eigen::Vector3f position = renderer_->writable(aimed.position);
        if (!renderer_->is_in_domain(position)) continue;
        batch.push_back(position);
        aims.push_back(name_of(same_bits(position, aimed.position) ? aimed.aim : properties::Aim::volume));
      }
      if (is_reset) path_.clear();
      const Path forces = renderer_->forces(batch, is_reset);
      for (std::size_t i = 0; i < batch.size(); ++i) {
        path_.push_back(batch[i]);
        const auto judged =
            judge.add({batch[i], is_reset && i == 0, forces[i], std::string(aims[i]), "position " + std::to_string(done + i)});
        if (is_beyond(judged) && failing_path_.empty()) failing_path_ = path_;
      }
      done += batch.size();
    }
    touch_each_triangle(judge);
    found_.judgement = judge.judgement();
  }

  // From the front of each triangle of a mesh to behind it, so that one that is wrong is found among many. The real-time path
  // chooses what the exact side, which looks at every triangle in each tick, has to judge.
  void touch_each_triangle(Judge& judge) {
    const auto* mesh = std::get_if<MeshRendering>(&description_.what);
    if (mesh == nullptr) return;
    const std::size_t count = mesh->mesh().triangles.size(), stride = (count + kMostTouched - 1) / kMostTouched;
    int judged = 0;
    for (std::size_t triangle = 0; triangle < count && judged < kMostJudgedTriangles; triangle += stride) {
      if (triangle % 256 == 0) monitor_.at(0.9);
      const Path path = through_triangle(mesh->mesh(), triangle, *renderer_);
      if (!std::ranges::all_of(path, [this](const Eigen::Vector3f& one) { return renderer_->is_in_domain(one); })) continue;
      const Path forces = renderer_->forces(path, true);
      const auto session = subject_->renderer().open();
      if (std::ranges::equal(path, forces, [&session](const Eigen::Vector3f& position, const Eigen::Vector3f& force) {
            return session->step(position).force == force;
          }))
        continue;
      ++judged;
      for (std::size_t i = 0; i < path.size(); ++i) {
        const auto judged = judge.add({path[i], i == 0, forces[i], "each triangle", "triangle " + std::to_string(triangle)});
        if (is_beyond(judged) && failing_path_.empty())
          failing_path_.assign(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      }
    }
  }

  // Whether the last answer of the path, begun anew, is beyond the tolerance; of a path whose last position is judged.
  bool fails(const Path& path) {
    if (tries_ == kMostTries) return false;
    ++tries_;
    const Path forces = renderer_->forces_along(path);
    Judge judge(subject_, options_.tolerance);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) judge.add({path[i], i == 0, forces[i]});
    const auto judged = judge.add({path.back(), path.size() == 1, forces.back()});
    if (is_beyond(judged)) found_.counterexample = judged;
    return is_beyond(judged);
  }

  // Fewer positions first, then ones that are shorter to write.
  void shorten() {
    if (failing_path_.empty()) return;
    Path path = failing_path_;
    if (!found_.hello.remembers) path = {path.back()};
    if (!fails(path)) return;  // it gives two answers; the next check says so
    for (bool is_shorter = true; is_shorter;) {
      is_shorter = false;
      for (Path& next : properties::shorter(path, 1))
        if (same_bits(next.back(), path.back()) && fails(next)) {
          path = std::move(next);
          is_shorter = true;
          break;
        }
      monitor_.at(0.92);
    }
    for (std::size_t i = 0; i < path.size(); ++i)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        for (const float simple : simpler(path[i][axis])) {
          Path next = path;
          next[i][axis] = simple;
          next[i] = renderer_->writable(next[i]);
          if (!fails(next)) continue;
          path = std::move(next);
          break;
        }
    found_.shortest_path = path;
  }

  // 0, and the number with fewer bits, the simplest first; never NaN or infinite.
  static std::vector<float> simpler(float value) {
    std::vector<float> all;
    if (!std::isfinite(value) || value == 0) return all;
    all.push_back(0);
    int exponent = 0;
    const float part = std::frexp(value, &exponent);
    for (int bits = 1; bits < 24; ++bits) {
      const float rounded = std::ldexp(std::round(std::ldexp(part, bits)), exponent - bits);
      if (rounded == value) break;
      if (all.back() != rounded) all.push_back(rounded);
    }
    return all;
  }

  void look_at_invariants() {
    const Trial trial{description_, *subject_,     [this](const Description& other) { return opened_on(other); },
                      *renderer_,   options_.seed, monitor_};
    for (const auto& invariant : kInvariants) {
      monitor_.at(0.95);
      found_.invariants.push_back(invariant(trial));
    }
    if (options_.is_timed) take_times(trial);
  }

  void take_times(const Trial& trial) {
    found_.timing = time_answers(*renderer_, drawn_path(trial, kTimedPath, options_.seed + 2));
    if (!options_.most_seconds) return;
    Invariant invariant{"an answer takes at most " + files::shortest(*options_.most_seconds) + " s", found_.timing->answers};
    if (found_.timing->worst > *options_.most_seconds)
      invariant.violated("the slowest took " + files::shortest(found_.timing->worst) +
                         " s: a device in a loop at that rate gets a late force, or the last one again");
    found_.invariants.push_back(std::move(invariant));
  }

  const Description& description_;
  const OpenRenderer& open_;
  const ConformOptions& options_;
  const Monitor& monitor_;
  const std::shared_ptr<const properties::Subject> subject_;
  std::unique_ptr<SceneRenderer> renderer_;
  Path path_, failing_path_;  // since the last reset; the first that led to an answer beyond the tolerance
  int tries_ = 0;
  Conformance found_;
};

}  // namespace

bool Conformance::held() const {
  return is_applicable() && !failure && (!hello.claims_definition || judgement.held()) &&
         std::ranges::none_of(invariants, [](const Invariant& each) { return each.violation.has_value(); });
}

Conformance conform(const Description& description, const OpenRenderer& open, const ConformOptions& options,
                    const Monitor& monitor) {
  return Run(description, open, options, monitor).run();
}

}  // namespace forceshade::conformance
