// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/conform.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "files/csv.h"
#include "properties/binary32.h"

namespace forceshade::conformance {
namespace {

using Path = std::vector<Eigen::Vector3f>;
using properties::show;

constexpr std::size_t kBatch = 1024;         // positions that are asked at once
constexpr std::size_t kInvariantPath = 500;  // positions of the path on which invariants are looked at
constexpr int kMostTries = 2000;             // of simpler paths
constexpr int kRest = 100;                   // ticks at one position

bool same(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::equal(a.begin(), a.end(), b.begin(), properties::same_bits);
}

// Asks in batches.
Path forces_along(RendererUnderTest& renderer, const Path& path) {
  Path forces;
  for (std::size_t begin = 0; begin < path.size(); begin += kBatch) {
    const std::size_t size = std::min(kBatch, path.size() - begin);
    const Path some = renderer.forces(std::span(path).subspan(begin, size), begin == 0);
    forces.insert(forces.end(), some.begin(), some.end());
  }
  return forces;
}

class Run {
 public:
  Run(const std::shared_ptr<const properties::Subject>& subject, const OpenRenderer& open, const ConformOptions& options,
      const Monitor& monitor)
      : open_(open), options_(options), monitor_(monitor), subject_(subject) {}

  Conformance run() {
    try {
      renderer_ = open_();
      found_.hello = renderer_->hello();
      if (found_.hello.refusal) return found_;
      compare();
      shorten();
      repeat();
      rest();
      stay_finite();
      renderer_->say_goodbye();
    } catch (const RendererFailed& failure) {
      found_.failure = failure.what();
    }
    return found_;
  }

 private:
  void compare() {
    Judge judge(subject_, options_.tolerance);
    const auto positions = subject_->positions(options_.seed);
    for (std::uint64_t done = 0; done < options_.points;) {
      monitor_.at(0.9 * static_cast<double>(done) / static_cast<double>(options_.points));
      const std::uint64_t of_this_path = std::min(kPathLength - done % kPathLength, options_.points - done);
      const bool is_reset = done % kPathLength == 0;
      Path batch;
      std::vector<properties::Aim> aims;
      for (std::uint64_t i = 0; i < std::min<std::uint64_t>(kBatch, of_this_path); ++i) {
        const properties::Aimed aimed = positions->next();
        batch.push_back(aimed.position);
        aims.push_back(aimed.aim);
      }
      if (is_reset) path_.clear();
      const Path forces = renderer_->forces(batch, is_reset);
      for (std::size_t i = 0; i < batch.size(); ++i) {
        path_.push_back(batch[i]);
        const std::uint64_t before = judge.judgement().all.beyond;
        judge.add(
            {batch[i], is_reset && i == 0, forces[i], std::string(name_of(aims[i])), "position " + std::to_string(done + i)});
        if (judge.judgement().all.beyond > before && failing_path_.empty()) failing_path_ = path_;
      }
      done += batch.size();
    }
    found_.judgement = judge.judgement();
  }

  // Whether the last answer of the path, begun anew, is beyond the tolerance; of a path whose last position is judged.
  bool fails(const Path& path) {
    if (tries_ == kMostTries) return false;
    ++tries_;
    const Path forces = forces_along(*renderer_, path);
    Judge judge(subject_, options_.tolerance);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) judge.add({path[i], i == 0, forces[i]});
    const std::uint64_t before = judge.judgement().all.beyond;
    judge.add({path.back(), path.size() == 1, forces.back()});
    return judge.judgement().all.beyond > before;
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
        if (same(next.back(), path.back()) && fails(next)) {
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

  Path drawn_path() const {
    const auto positions = subject_->positions(options_.seed + 1);
    Path path;
    for (std::size_t i = 0; i < kInvariantPath; ++i) path.push_back(positions->next().position);
    return path;
  }

  void violated(Invariant& invariant, const std::string& words) {
    if (!invariant.violation) invariant.violation = words;
  }

  // The same path, begun again, and in a renderer that was opened anew, gives the same bits.
  void repeat() {
    const Path path = drawn_path(), first = forces_along(*renderer_, path), again = forces_along(*renderer_, path);
    const auto fresh_renderer = open_();
    const Path fresh = forces_along(*fresh_renderer, path);
    fresh_renderer->say_goodbye();
    compare_answers("the same path twice gives the same bits", path, first, again, "the second time");
    compare_answers("a reset equals a fresh start", path, first, fresh, "opened anew");
    monitor_.at(0.95);
  }

  void compare_answers(const std::string& name, const Path& path, const Path& one, const Path& other, const std::string& when) {
    Invariant invariant{name, path.size()};
    for (std::size_t i = 0; i < path.size(); ++i)
      if (!same(one[i], other[i]))
        violated(invariant, "at " + show(path[i]) + " mm, position " + std::to_string(i) + " of the path: " + show(one[i]) +
                                " N, and " + when + ' ' + show(other[i]) + " N: a hand would feel " +
                                newtons(one[i] - other[i]) + " without having moved otherwise");
    found_.invariants.push_back(std::move(invariant));
  }

  // Resting is still: at one position the force does not change from the second tick on.
  void rest() {
    Invariant invariant{"a hand at rest feels a force at rest", 0};
    for (std::size_t i = 0; const Eigen::Vector3f& position : drawn_path()) {
      if (!position.allFinite() || ++i % 25 != 0) continue;
      const Path forces = forces_along(*renderer_, Path(kRest, position));
      ++invariant.cases;
      for (std::size_t tick = 2; tick < forces.size(); ++tick)
        if (!same(forces[tick], forces[1]))
          violated(invariant, "at " + show(position) + " mm, tick " + std::to_string(tick) + ": " + show(forces[1]) +
                                  " N became " + show(forces[tick]) + " N: a hand at rest would feel " +
                                  newtons(forces[tick] - forces[1]));
    }
    found_.invariants.push_back(std::move(invariant));
  }

  // Whatever the position, the force is a finite one; after it, the renderer goes on as from a fresh start.
  void stay_finite() {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
    const std::array<float, 7> odd{kNan,
                                   kInfinite,
                                   -kInfinite,
                                   1e26F,
                                   -1e26F,
                                   std::numeric_limits<float>::denorm_min(),
                                   std::numeric_limits<float>::max()};
    Invariant invariant{"any position gets a finite force", 0};
    for (const float number : odd)
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        Eigen::Vector3f position(1, 1, -0.5F);
        position[axis] = number;
        const Path forces = forces_along(*renderer_, {position});
        ++invariant.cases;
        if (!forces[0].allFinite())
          violated(invariant, "at " + show(position) + " mm the force is " + show(forces[0]) +
                                  " N: a device gets no force, the last one, or its largest");
      }
    found_.invariants.push_back(std::move(invariant));
    monitor_.at(1);
  }

  static std::string newtons(const Eigen::Vector3f& difference) {
    return files::shortest(difference.cast<double>().norm()) + " N";
  }

  const OpenRenderer& open_;
  const ConformOptions& options_;
  const Monitor& monitor_;
  const std::shared_ptr<const properties::Subject> subject_;
  std::unique_ptr<RendererUnderTest> renderer_;
  Path path_, failing_path_;  // since the last reset; the first that led to an answer beyond the tolerance
  int tries_ = 0;
  Conformance found_;
};

}  // namespace

bool Conformance::held() const {
  return is_applicable() && !failure && judgement.held() &&
         std::ranges::none_of(invariants, [](const Invariant& each) { return each.violation.has_value(); });
}

Conformance conform(const std::shared_ptr<const properties::Subject>& subject, const OpenRenderer& open,
                    const ConformOptions& options, const Monitor& monitor) {
  return Run(subject, open, options, monitor).run();
}

}  // namespace forceshade::conformance
