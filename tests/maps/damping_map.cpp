// SPDX-License-Identifier: BSD-3-Clause
// Prints up to which stiffness a damped wall is passive, and up to which stable, on the simulated devices, in simulation and in
// theory: the CSV of tests/maps/damping_map.sh. Fails where the condition of docs/damping.md allows what the search finds to
// give energy.

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "device/simulated/model.h"
#include "forceshade/fast.h"
#include "properties/split_mix.h"

namespace {

using namespace forceshade;

constexpr std::array kShares{1.0F, 0.3F, 0.1F};
constexpr std::array kRates{1000, 500, 200};  // Hz
constexpr double kLeast = 1e-3, kMost = 1e3;  // N/mm: the range of a law

fast::Law wall_of(double stiffness) {
  return std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = static_cast<float>(stiffness)}));
}
fast::Damping damping_of(double rate, float share, double damping) {
  return std::get<fast::Damping>(fast::Damping::build(
      {.rate = static_cast<float>(rate), .share = share, .damping = static_cast<float>(damping < 0x1p-20 ? 0 : damping)}));
}
double force(const fast::Law& wall, fast::Damping& damping, double z) {
  const Eigen::Vector3f position(0, 0, static_cast<float>(z));
  return static_cast<double>(damping.tick(position, 1, wall.evaluate(position)).force.z());
}

// The energy for a hand that repeats a path, over K Σ‖Δ‖²; the least b/(KT) with which the device takes as much.
double given(const std::vector<double>& path, float share, double damping_over_stiffness) {
  constexpr double kStiffness = 0.5, kRate = 1000;
  const fast::Law wall = wall_of(kStiffness);
  fast::Damping damping = damping_of(kRate, share, damping_over_stiffness * kStiffness / kRate);
  const std::size_t size = path.size(), before = static_cast<std::size_t>(8 / share);
  double work = 0, ways = 0;
  for (std::size_t tick = 0; tick < before + 2 * size; ++tick) {
    const double z = path[tick % size], way = path[(tick + 1) % size] - z, f = force(wall, damping, z);
    if (tick < before + size || (tick - before) / size != 1) continue;
    work += f * way;
    ways += way * way;
  }
  return ways > 1e-9 ? work / (kStiffness * ways) : 0;
}

// The most that a search finds over closed paths of 2 to 12 ticks, which it changes one position at a time.
double most_given(float share, double damping_over_stiffness) {
  std::uint64_t drawn = 0;
  const auto random = [&] { return std::ldexp(static_cast<double>(properties::split_mix(1, drawn++) >> 11U), -53) * 2 - 1; };
  double most = 0;
  for (const std::size_t size : {2, 3, 4, 6, 8, 12})
    for (int start = 0; start < 3; ++start) {
      std::vector<double> path(size);
      for (std::size_t i = 0; i < size; ++i) path[i] = start == 0 ? -0.9 + (i % 2 == 0 ? 0.02 : 0) : random();
      double best = given(path, share, damping_over_stiffness);
      for (int change = 0; change < 1500; ++change) {
        std::vector<double> other = path;
        other[static_cast<std::size_t>(change) % size] += random() * std::exp2(5 * random() - 5);
        const double its = given(other, share, damping_over_stiffness);
        if (its <= best) continue;
        best = its;
        path = other;
      }
      most = std::max(most, best);
    }
  return most;
}

// most_given() over B/(KT), by its binary logarithm.
class MostGiven {
 public:
  explicit MostGiven(float share) : none_(most_given(share, 0)) {
    for (std::size_t i = 0; i < most_.size(); ++i) most_[i] = most_given(share, std::exp2(kFirst + static_cast<double>(i)));
  }
  double at(double damping_over_stiffness) const {
    // Linear between two of them, and on beyond the last.
    const double place = std::max(0.0, std::floor(std::log2(damping_over_stiffness) - kFirst + 1));
    const auto i = static_cast<std::size_t>(std::min(place, static_cast<double>(most_.size()) - 1));
    const double end = std::exp2(kFirst + static_cast<double>(i)), begin = i == 0 ? 0 : end / 2,
                 before = i == 0 ? none_ : most_[i - 1];
    return before + (most_[i] - before) * (damping_over_stiffness - begin) / (end - begin);
  }

 private:
  static constexpr double kFirst = -5;
  double none_;
  std::array<double, 12> most_{};
};

struct Device {
  const char* name;
  double mass, viscous;  // kg, N·s/m: along the wall's normal, in the reset pose
};

Device device_of(const device::Model& model) {
  const device::Pose pose = device::Joints(0, 0, 0);
  const Eigen::Matrix3d inverse = model.arm.jacobian(pose).inverse();
  const Eigen::Matrix3d viscous = inverse.transpose() * model.viscous.asDiagonal() * inverse;
  return {model.name.data(), device::apparent_mass(model.arm, pose)(1, 1), viscous(1, 1)};
}

// The motion of a mass in a period under a held force.
struct Held {
  double speed, way_of_speed, speed_of_force, way_of_force;

  Held(const Device& its, double period)
      : speed(std::exp(-its.viscous * period / its.mass)),
        way_of_speed((1 - speed) * its.mass / its.viscous),
        speed_of_force((1 - speed) / its.viscous),
        way_of_force((period - way_of_speed) / its.viscous) {}
};

// A mass that is pushed into the wall from its surface, to a balance 1 mm below, comes nearer to it in the second ten of 20 s.
bool is_stable(const Device& its, double rate, float share, double stiffness, double damping) {
  const fast::Law wall = wall_of(stiffness);
  fast::Damping damper = damping_of(rate, share, damping);
  const Held held(its, 1 / rate);
  double x = 0, v = 0;  // m, m/s
  std::array<double, 2> away{};
  const int half = static_cast<int>(10 * rate);
  for (int tick = 0; tick < 2 * half; ++tick) {
    const double f = force(wall, damper, 1e3 * x) - stiffness;
    x += held.way_of_speed * v + held.way_of_force * f;
    v = held.speed * v + held.speed_of_force * f;
    const double off = 1e3 * x + 1;
    away[static_cast<std::size_t>(tick / half)] += off * off;
    if (!(std::abs(x) < 1)) return false;
  }
  return away[1] < 0.95 * away[0] || away[1] < 1e-8 * half;
}

// The same without limits or a surface: all roots of the sampled system lie in the unit circle.
bool is_stable_linear(const Device& its, double rate, float share, double stiffness, double damping) {
  const Held held(its, 1 / rate);
  const double a = static_cast<double>(share), k = 1e3 * stiffness, db = 1e3 * damping * rate * a;
  Eigen::Matrix4d next;  // of position, speed, the position before it and the filtered velocity times B
  next << 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, db, 0, -db, 1 - a;
  const Eigen::RowVector4d pull = -k * Eigen::RowVector4d::Unit(0) - next.row(3);
  next.row(0) = Eigen::RowVector4d(1, held.way_of_speed, 0, 0) + held.way_of_force * pull;
  next.row(1) = Eigen::RowVector4d(0, held.speed, 0, 0) + held.speed_of_force * pull;
  return (next.eigenvalues().cwiseAbs().array() < 1 - 1e-9).all();
}

// The largest stiffness up to which all are so; 0 for none.
template <class Is>
double up_to(const Is& is) {
  double stiffness = 0;
  for (double next = kLeast; next <= kMost && is(next); next *= 1.1) stiffness = next;
  return stiffness;
}

}  // namespace

int main() {
  bool is_right = true;
  std::printf("device,rate_Hz,share,damping_N_s_per_mm,passive,passive_by_condition,passive_linear,stable,stable_linear\n");
  for (const float share : kShares) {
    const MostGiven most(share);
    const double a = static_cast<double>(share);
    for (const auto& model : device::kModels) {
      const Device its = device_of(model());
      for (const double rate : kRates)
        for (int i = 0; i <= 24; ++i) {
          const double damping = 1e-6 * std::pow(10, i / 5.0), b = its.viscous / 1e3;
          const auto limit = [&](double of_damping) { return std::max(0.0, 2 * (b - of_damping * damping) * rate); };
          const double passive = up_to([&](double k) { return b >= k / rate * most.at(damping * rate / k); }),
                       condition = limit(damping::sampling_factor(a));
          is_right = is_right && condition <= 1.1 * passive + kLeast;
          std::printf("%s,%g,%g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g\n", its.name, rate, a, damping, passive, condition,
                      limit(a / (2 - a)), up_to([&](double k) { return is_stable(its, rate, share, k, damping); }),
                      up_to([&](double k) { return is_stable_linear(its, rate, share, k, damping); }));
        }
    }
  }
  return is_right ? 0 : 1;
}
