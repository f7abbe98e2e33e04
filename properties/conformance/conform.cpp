// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/conform.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <future>
#include <span>
#include <thread>
#include <utility>

#include "files/csv.h"
#include "forceshade/damped.h"
#include "forceshade/error.h"
#include "properties/conformance/invariants/all.h"
#include "properties/conformance/scene.h"
#include "properties/conformance/strokes.h"
#include "properties/conformance/timing.h"
#include "rendering/control_words.h"

namespace forceshade::conformance {
namespace {

constexpr int kMostTries = 2000;               // of simpler paths
constexpr std::size_t kMostTouched = 200'000;  // triangles
constexpr int kMostJudgedTriangles = 500;      // of those whose force is not this program's own
constexpr std::size_t kTimedPath = 500;        // positions

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
    } catch (const files::ProcessFailed& failure) {
      found_.failure = failure.what();
    }
    return found_;
  }

 private:
  SceneRenderer opened_on(const Description& description) const {
    return {open_(scene_of(description)), description.stiffness()};
  }

  // Answers in other units are rounded once more when they are made forces in N.
  void expect_meaning_of_tolerance() const {
    const Hello& its = found_.hello;
    const bool is_force = its.answer == Answer::force && its.newtons == 1;
    if (is_force || options_.tolerance.unit != Unit::ulp || !options_.tolerance.value.is_zero()) return;
    throw Error(
        "--tolerance: expected at least 1 ulp, or N or %, for a renderer whose answers are no forces in N, since these are "
        "rounded when they are made such");
  }

  void compare() {
    Strokes ticks(subject_->positions(options_.seed), found_.hello.damping.has_value(), options_.seed);
    for (std::uint64_t done = 0; done < options_.points;) {
      std::vector<Case> cases;
      cases.reserve(kPathLength);
      while (cases.size() < kPathLength && done < options_.points) {
        monitor_.at(0.9 * static_cast<double>(done) / static_cast<double>(options_.points));
        const std::uint64_t room = std::min(kPathLength - cases.size(), options_.points - done);
        answer_more(ticks, std::min<std::uint64_t>(SceneRenderer::kBatch, room), cases, done);
      }
      judge_meanwhile(std::move(cases));
    }
    touch_each_triangle();
    while (!pending_.empty()) take_first();
  }

  // The next positions of a path, with the renderer's answers.
  void answer_more(Strokes& ticks, std::uint64_t count, std::vector<Case>& cases, std::uint64_t& done) {
    const std::size_t first = cases.size();
    Path batch;
    std::vector<std::uint32_t> periods;
    while (batch.size() < count) {
      const auto [aimed, since] = ticks.next();
      const Eigen::Vector3f position = renderer_->writable(aimed.position);
      if (!renderer_->is_in_domain(position)) continue;
      batch.push_back(position);
      if (found_.hello.damping) periods.push_back(since);
      const properties::Aim aim = same_bits(position, aimed.position) ? aimed.aim : properties::Aim::volume;
      cases.push_back({position, cases.empty(), {}, std::string(name_of(aim)), "position " + std::to_string(done++), since});
    }
    const Path forces = renderer_->forces(batch, first == 0, periods);
    for (std::size_t i = 0; i < forces.size(); ++i) cases[first + i].force = forces[i];
  }

  // From the front of each triangle of a mesh to behind it, so that one that is wrong is found among many. The real-time path
  // chooses what the exact side, which looks at every triangle in each tick, has to judge.
  void touch_each_triangle() {
    const auto* mesh = std::get_if<MeshRendering>(&description_.what);
    if (mesh == nullptr) return;
    const std::size_t count = mesh->mesh().triangles.size(), stride = (count + kMostTouched - 1) / kMostTouched;
    std::vector<Case> cases;
    int judged_triangles = 0;
    for (std::size_t triangle = 0; triangle < count && judged_triangles < kMostJudgedTriangles; triangle += stride) {
      if (triangle % 256 == 0) monitor_.at(0.9);
      const Path path = through_triangle(mesh->mesh(), triangle, *renderer_);
      if (!std::ranges::all_of(path, [this](const Eigen::Vector3f& one) { return renderer_->is_in_domain(one); })) continue;
      const Path forces = renderer_->forces(path, true);
      const auto session = damped(subject_->renderer().open());
      if (std::ranges::equal(path, forces, [&session](const Eigen::Vector3f& position, const Eigen::Vector3f& force) {
            return session->step(position).force == force;
          }))
        continue;
      ++judged_triangles;
      for (std::size_t i = 0; i < path.size(); ++i)
        cases.push_back({path[i], i == 0, forces[i], "each triangle", "triangle " + std::to_string(triangle)});
      if (cases.size() >= kPathLength) judge_meanwhile(std::exchange(cases, {}));
    }
    judge_meanwhile(std::move(cases));
  }

  // This program's own answers with the declared damping.
  std::unique_ptr<fast::Session> damped(std::unique_ptr<fast::Session> session) const {
    if (!found_.hello.damping) return session;
    return fast::damped(std::move(session), std::get<fast::Damping>(fast::Damping::build(*found_.hello.damping)));
  }

  struct Timed {
    Eigen::Vector3f position;
    std::uint32_t periods;
  };
  struct JudgedPaths {
    Judgement judgement;
    std::vector<Timed> failing;  // to the first answer that is beyond the tolerance
  };

  // Whole paths. Several threads may be in it.
  JudgedPaths judged(const std::vector<Case>& cases, std::uint64_t before) const {
    Judge judge(subject_, options_.tolerance, before, found_.hello.damping);
    JudgedPaths paths;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      if (cases[i].is_reset) begin = i;
      if (!judge.add(cases[i]) || !paths.failing.empty()) continue;
      for (const Case& its : std::span(cases).subspan(begin, i + 1 - begin))
        paths.failing.push_back({its.position, its.periods});
    }
    paths.judgement = judge.judgement();
    return paths;
  }

  // While the renderer answers further ones. What is found is put together in the order of the calls.
  void judge_meanwhile(std::vector<Case> cases) {
    if (pending_.size() >= std::max(1U, std::thread::hardware_concurrency())) take_first();
    const std::uint64_t before = std::exchange(given_to_judges_, given_to_judges_ + cases.size());
    pending_.push_back(std::async(std::launch::async, [this, its = std::move(cases), before] { return judged(its, before); }));
  }

  void take_first() {
    const JudgedPaths paths = pending_.front().get();
    pending_.pop_front();
    found_.judgement.append(paths.judgement);
    if (failing_path_.empty()) failing_path_ = paths.failing;
  }

  // True if the last answer of the path, begun anew, is beyond the tolerance; of a path whose last position is judged.
  bool fails(const std::vector<Timed>& path) {
    if (tries_ == kMostTries) return false;
    ++tries_;
    Path positions;
    std::vector<std::uint32_t> periods;
    for (const Timed& each : path) {
      positions.push_back(each.position);
      if (found_.hello.damping) periods.push_back(each.periods);
    }
    const Path forces = renderer_->forces_along(positions, periods);
    Judge judge(subject_, options_.tolerance, 0, found_.hello.damping);
    std::optional<Judged> beyond;  // of the last one
    for (std::size_t i = 0; i < path.size(); ++i)
      beyond = judge.add({positions[i], i == 0, forces[i], "", "", path[i].periods});
    if (!beyond) return false;
    found_.counterexample = beyond;
    found_.shortest_path = positions;
    found_.periods_of_shortest_path = periods;
    return true;
  }

  // Fewer positions first, then ones that are shorter to write.
  void shorten() {
    if (failing_path_.empty()) return;
    std::vector<Timed> path = failing_path_;
    if (!found_.hello.remembers) path = {path.back()};
    if (!fails(path)) return;  // it gives two answers; the next check says so
    for (bool is_shorter = true; is_shorter;) {
      is_shorter = false;
      for (std::vector<Timed>& next : properties::shorter(path, 1))
        if (same_bits(next.back().position, path.back().position) && fails(next)) {
          path = std::move(next);
          is_shorter = true;
          break;
        }
      monitor_.at(0.92);
    }
    for (std::size_t i = 0; i < path.size(); ++i)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        for (const float simple : simpler(path[i].position[axis])) {
          std::vector<Timed> next = path;
          next[i].position[axis] = simple;
          next[i].position = renderer_->writable(next[i].position);
          if (!fails(next)) continue;
          path = std::move(next);
          break;
        }
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
    Trial trial{description_, *subject_,     [this](const Description& other) { return opened_on(other); },
                *renderer_,   options_.seed, monitor_};
    trial.approaches = approaches_to(trial);
    trial.tolerance = options_.tolerance;
    const auto look_at = [&](const auto& invariants) {
      for (const auto& invariant : invariants) {
        monitor_.at(0.95);
        found_.invariants.push_back(invariant(trial));
      }
    };
    look_at(kInvariants);
    if (found_.hello.damping) look_at(kDampingInvariants);
    if (options_.is_timed) take_times(trial);
  }

  void take_times(const Trial& trial) {
    found_.timing = time_answers(*renderer_, drawn_path(trial, kTimedPath, options_.seed + 2));
    if (!options_.most_seconds) return;
    Invariant invariant{"an answer takes at most " + shortest(*options_.most_seconds) + " s", found_.timing->answers};
    if (found_.timing->worst > *options_.most_seconds)
      invariant.violated("the slowest took " + shortest(found_.timing->worst) +
                         " s: a device in a loop at that rate gets a late force, or the last one again");
    found_.invariants.push_back(std::move(invariant));
  }

  const Description& description_;
  const OpenRenderer& open_;
  const ConformOptions& options_;
  const Monitor& monitor_;
  const std::shared_ptr<const properties::Subject> subject_;
  std::unique_ptr<SceneRenderer> renderer_;
  std::vector<Timed> failing_path_;  // the first that led to an answer beyond the tolerance
  int tries_ = 0;
  Conformance found_;
  std::uint64_t given_to_judges_ = 0;             // cases
  std::deque<std::future<JudgedPaths>> pending_;  // in the order of the paths; the last member, so that none outlives the rest
};

}  // namespace

bool Conformance::held() const {
  return is_applicable() && !failure && (!hello.claims_definition || judgement.held()) &&
         std::ranges::none_of(invariants, [](const Invariant& each) { return each.violation.has_value(); });
}

Conformance conform(const Description& description, const OpenRenderer& open, const ConformOptions& options,
                    const Monitor& monitor) {
  const ExactArithmetic with_all_bits;
  return Run(description, open, options, monitor).run();
}

}  // namespace forceshade::conformance
