// SPDX-License-Identifier: BSD-3-Clause
// Searches for the hardest inputs of a height map and prints them as its case file:
//
//   ninja -C build/release hard_cases_search_heights
//   build/release/tests/hard_cases_search_heights cone > tests/height_maps/height_cone.cases
//
// Every force is K times a number that does not depend on K: at each position sweep.h finds the stiffnesses that bring it next
// to a tie. Contact does not depend on K: there the positions are taken whose surface is nearest to a binary32 height. The
// force, the status and the distance in the file are the reference's and those of 2048 bits.

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>

#include "forceshade/reference.h"
#include "sweep.h"
#include "tests/height_maps/height_cases.h"

namespace forceshade::tests {
namespace {

using fast::DoubleWithError;
using BigFloatBall = fast::BigFloatBall<32>;

struct HeightCandidate {
  float K;
  Eigen::Vector3f at;
  double score;  // larger is harder
};

// The hardest candidates of each kind, one per column (x, y).
class HardestOfMap {
 public:
  void offer(const std::string& kind, const HeightCandidate& candidate) {
    std::vector<HeightCandidate>& all = kinds_[kind];
    const auto same =
        std::ranges::find_if(all, [&](const HeightCandidate& other) { return other.at.head<2>() == candidate.at.head<2>(); });
    if (same != all.end() && same->score >= candidate.score) return;
    if (same != all.end()) all.erase(same);
    all.push_back(candidate);
    std::ranges::sort(all, [](const HeightCandidate& a, const HeightCandidate& b) { return a.score > b.score; });
    if (all.size() > kMost) all.pop_back();
  }
  // The score that a candidate must exceed to be kept.
  double bar(const std::string& kind) const {
    const auto found = kinds_.find(kind);
    return found == kinds_.end() || found->second.size() < kMost ? 0 : found->second.back().score;
  }
  const std::map<std::string, std::vector<HeightCandidate>>& kinds() const { return kinds_; }

 private:
  static constexpr std::size_t kMost = 2;
  std::map<std::string, std::vector<HeightCandidate>> kinds_;
};

class HeightSearch {
 public:
  HeightSearch(const HeightScene& scene, height::Mode mode) : scene_(scene), mode_(mode), balls_(scene) {}

  void run(std::uint64_t positions) {
    for (std::uint64_t i = 0; i < positions; ++i) {
      const bool has_few_bits = i % 8 == 0;
      Eigen::Vector3f at(coordinate(has_few_bits), coordinate(has_few_bits), 0);
      const auto height = static_cast<float>(balls_.at<DoubleWithError>(at, mode_, 1).gap.value);
      contact(at, height);
      const std::uint64_t bits = random_();
      at.z() = fast::quantised(has_few_bits
                                   ? static_cast<float>(static_cast<int>(height * 16) - 1 - static_cast<int>(bits % 32)) / 16
                                   : height - std::ldexp(static_cast<float>(bits >> 40), -24 - static_cast<int>(bits % 16)));
      force(at, has_few_bits);
    }
  }
  const HardestOfMap& hardest() const { return hardest_; }

 private:
  // A coordinate of the scene's size; with few bits, multiples of 1/16 mm and the scene's edges, where ties and exact contact
  // are.
  float coordinate(bool has_few_bits) {
    const std::uint64_t bits = random_();
    const auto any = static_cast<float>(static_cast<std::int32_t>(bits) >> 8) * scene_.step;
    if (!has_few_bits) return fast::quantised(any);
    return bits >> 62 == 0 ? scene_.edges[(bits >> 33) % scene_.edges.size()] : std::round(16 * any) / 16;
  }

  // Offers the binary32 heights next to the surface, by their distance from it.
  void contact(Eigen::Vector3f at, float height) {
    if (std::fabs(height) < 1e-3F) return;
    for (const float z : {std::nextafter(height, -1e5F), height, std::nextafter(height, 1e5F)}) {
      at.z() = z;
      const DoubleDouble gap = balls_.at<DoubleDouble>(at, mode_, 1).gap;
      if (!(gap.error < 0x1p-70 * std::fabs(static_cast<double>(height)))) return;
      const bool may_be_zero = std::fabs(gap.hi) <= gap.error;
      const double share = std::fabs(gap.hi / static_cast<double>(z));
      if (may_be_zero) {
        if (wide_left_ == 0) continue;
        --wide_left_;
        const fast::Sign sign = proved_sign(balls_.at<BigFloatBall>(at, mode_, 1).gap);
        hardest_.offer(sign == fast::Sign::zero ? "contact: on the surface" : "contact: as if on the surface",
                       {0.75F, at, static_cast<double>(random_() % 1000)});
      } else {
        hardest_.offer(gap.hi > 0 ? "contact: nearest below the surface" : "contact: nearest above the surface",
                       {0.75F, at, -std::log2(share)});
      }
    }
  }

  void force(const Eigen::Vector3f& at, bool may_tie) {
    const auto unit = balls_.at<DoubleDouble>(at, mode_, 1);
    if (!unit.decided || !(unit.gap.hi > 4 * unit.gap.error)) return;
    const auto first = balls_.at<DoubleWithError>(at, mode_, 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const DoubleDouble& c = unit.force[axis];
      if (c.hi == 0 || !(c.error < 0x1p-76 * std::fabs(c.hi)) || std::fabs(c.hi) < 0x1p-100) continue;
      const std::string component = std::string("F") + "xyz"[axis];
      nearest(component, at, axis, c, may_tie);
      across(component, at, axis, c, first.force[axis].value);
    }
  }

  // As near as no candidate before, and ties. 2^-37 is what the fixed point of next_in_range() can distinguish.
  void nearest(const std::string& component, const Eigen::Vector3f& at, std::size_t axis, const DoubleDouble& c, bool may_tie) {
    const std::string kind = component + ": nearest to a tie";
    const double bar = hardest_.bar(kind);
    const double reach =
        bar > 0 ? std::clamp(std::ldexp(1.0, static_cast<int>(std::ceil(24 - bar))), 0x1p-36, 0x1p-20) : 0x1p-20;
    for_stiffnesses_near_ties(c, -reach, 2 * reach, may_tie ? 8 : 2, [&](float K) {
      const DoubleDouble value = DoubleDouble::exactly(static_cast<double>(K)) * c;
      if (!holds_its_tie(value)) return hardest_.offer(kind, {K, at, -std::log2(presumed(value).from_tie)});
      if (wide_left_ == 0) return;
      --wide_left_;
      const BigFloatBall exact = balls_.at<BigFloatBall>(at, mode_, static_cast<double>(K)).force[axis];
      const BigFloatBall off = exact - BigFloatBall::exactly(tie_near(value.hi).at);
      if (sign(off) == fast::Sign::zero)
        hardest_.offer(component + ": a tie", {K, at, static_cast<double>(random_() % 1000)});
      else
        hardest_.offer(kind, {K, at, static_cast<double>(exact.exponent() - off.exponent())});
    });
  }

  // Tries stiffnesses just on the side of a tie from which binary64's error leads across.
  void across(const std::string& component, const Eigen::Vector3f& at, std::size_t axis, const DoubleDouble& c, double first) {
    const std::string kind = component + ": binary64 lands across the tie";
    const double error = ((first - c.hi) - c.lo) / c.hi;
    if (error == 0 || std::fabs(error) > 0x1p-30 || std::fabs(error) * 0x1p53 < 0.6 * hardest_.bar(kind)) return;
    const double width = std::min(0x1p-8, std::fabs(error) * 0x1.4p24);
    for_stiffnesses_near_ties(c, error > 0 ? -width : 0, width, 4, [&](float K) {
      const DoubleDouble value = DoubleDouble::exactly(static_cast<double>(K)) * c;
      if (holds_its_tie(value)) return;
      const double answer = balls_.at<DoubleWithError>(at, mode_, static_cast<double>(K)).force[axis].value;
      hardest_.offer(kind, {K, at, needed_window(answer, presumed(value).right)});
    });
  }

  const HeightScene& scene_;
  height::Mode mode_;
  Balls balls_;
  std::mt19937_64 random_{1995};
  HardestOfMap hardest_;
  int wide_left_ = 4000;  // further candidates that may be given 2048 bits, of those that double-double takes for ties
};

void print(const HeightScene& scene, height::Mode mode, const HardestOfMap& hardest) {
  const Balls balls(scene);
  for (const auto& [kind, candidates] : hardest.kinds())
    for (const HeightCandidate& candidate : candidates) {
      if (candidate.score <= 0) continue;
      const auto law = std::get<reference::HeightMapField>(reference::HeightMapField::build(scene.map, mode, candidate.K));
      const reference::Rounded exact = law.round_to_binary32(candidate.at);
      const HeightCase one{mode, candidate.K, candidate.at, exact.force, exact.status, "", kind, ""};
      std::string line;
      for (const float number :
           {one.stiffness, one.position.x(), one.position.y(), one.position.z(), one.force.x(), one.force.y(), one.force.z()}) {
        char text[40];
        std::snprintf(text, sizeof text, "%a,", static_cast<double>(number));
        line += text;
      }
      std::printf("%s,%s%s,%s,%s\n", height::name_of(mode).data(), line.c_str(),
                  one.status == Status::contact ? "contact" : "free", closeness(balls, one, is_about_gap(one)).c_str(),
                  kind.c_str());
      std::fprintf(stderr, "%s, %s: %g\n", height::name_of(mode).data(), kind.c_str(), candidate.score);
    }
}

}  // namespace
}  // namespace forceshade::tests

int main(int argc, char** argv) {
  using namespace forceshade;
  const std::string name = argc > 1 ? argv[1] : "";
  const auto scenes = tests::height_scenes();
  const auto scene = std::ranges::find(scenes, name, &tests::HeightScene::name);
  if (scene == scenes.end()) {
    std::fprintf(stderr, "usage: hard_cases_search_heights MAP [POSITIONS]; a map of tests/height_maps/height_scenes.h\n");
    return 2;
  }
  std::printf("rendering,K,x,y,z,Fx,Fy,Fz,status,closest,why\n");
  for (const auto& [mode, word] : height::kModes) {
    if (!tests::is_rendered(*scene, mode)) continue;
    tests::HeightSearch search(*scene, mode);
    search.run(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 200'000);
    tests::print(*scene, mode, search.hardest());
  }
}
