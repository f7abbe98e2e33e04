// SPDX-License-Identifier: BSD-3-Clause
// Dampers of others beside this project's, on the same strokes of a hand into a wall: prints a table, and writes the forces of
// the first stroke. dampers [FILE.csv]
#include <btBulletDynamicsCommon.h>
#include <forceshade/damped.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>
#ifdef HAS_MUJOCO
#include <mujoco/mujoco.h>
#endif

namespace {

constexpr double kStiffness = 0.5, kDamping = 0.002;  // N/mm, N·s/mm

// Answers the depth of a hand, mm, z below 0 in the wall, a period later each time, with the force along z, N.
using Damper = std::function<double(double z)>;
using MakeDamper = std::function<Damper(double rate)>;

Damper forceshade_damper(double rate, float share) {
  using namespace forceshade;
  const auto damping = std::get<fast::Damping>(
      fast::Damping::build({.rate = static_cast<float>(rate), .share = share, .damping = static_cast<float>(kDamping)}));
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = static_cast<float>(kStiffness)}));
  return [session = std::shared_ptr<fast::Session>(fast::damped(fast::session_of(law), damping))](double z) {
    return static_cast<double>(session->step({0, 0, static_cast<float>(z)}).force.z());
  };
}

// As the sources of CHAI3D 3.3.0 have it (cEffectSurface, cEffectViscosity, cGenericHapticDevice::estimateLinearVelocity), with
// a clock that is the hand's: inside, the spring less the viscosity times the velocity over the last 15 ms.
Damper chai3d_damper(double rate) {
  const auto window = static_cast<std::size_t>(0.015 * rate);
  return [=, past = std::deque<double>()](double z) mutable {
    past.push_back(z);
    if (past.size() > std::max<std::size_t>(window, 2)) past.pop_front();
    const auto periods = static_cast<double>(past.size() - 1);
    const double velocity = periods > 0 ? (z - past.front()) * rate / periods : 0;
    return z < 0 ? -kStiffness * z - kDamping * velocity : 0;
  };
}

// The velocity that a program gives to an engine: the last difference of positions, m/s.
class Difference {
 public:
  explicit Difference(double rate) : rate_(rate) {}
  double of(double z) {
    const double velocity = has_last_ ? 1e-3 * (z - last_) * rate_ : 0;
    has_last_ = true;
    last_ = z;
    return velocity;
  }

 private:
  double rate_, last_ = 0;
  bool has_last_ = false;
};

// A sphere of 1 t on a box, whose contact has stiffness and damping; put where the hand is before each step.
class Bullet {
 public:
  explicit Bullet(double rate) : period_(btScalar(1 / rate)), difference_(rate) {
    floor_.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, -1)));
    floor_.setContactStiffnessAndDamping(btScalar(1e18), 0);
    ball_.setContactStiffnessAndDamping(btScalar(1e3 * kStiffness), btScalar(1e3 * kDamping));
    ball_.setActivationState(DISABLE_DEACTIVATION);
    world_.setGravity(btVector3(0, 0, 0));
    world_.addRigidBody(&floor_);
    world_.addRigidBody(&ball_);
  }
  ~Bullet() {
    world_.removeRigidBody(&ball_);
    world_.removeRigidBody(&floor_);
  }

  double force(double z) {
    ball_.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 0, btScalar(kRadius + 1e-3 * z))));
    ball_.setLinearVelocity(btVector3(0, 0, btScalar(difference_.of(z))));
    world_.stepSimulation(period_, 0);
    double impulse = 0;
    for (int k = 0; k < dispatcher_.getNumManifolds(); ++k)
      for (int i = 0; i < dispatcher_.getManifoldByIndexInternal(k)->getNumContacts(); ++i)
        impulse += static_cast<double>(dispatcher_.getManifoldByIndexInternal(k)->getContactPoint(i).getAppliedImpulse());
    return impulse / static_cast<double>(period_);
  }

 private:
  static constexpr double kRadius = 0.05;  // m
  btScalar period_;
  Difference difference_;
  btBoxShape box_{btVector3(1, 1, 1)};
  btSphereShape sphere_{btScalar(kRadius)};
  btRigidBody floor_{0, nullptr, &box_}, ball_{1000, nullptr, &sphere_, btVector3(1, 1, 1)};
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
};

#ifdef HAS_MUJOCO
// A sphere of 1 kg that does not turn above a plane, whose contact has solref = (-stiffness, -damping), at one impedance.
class Mujoco {
 public:
  explicit Mujoco(double rate) : difference_(rate) {
    char text[800];
    const int size =
        std::snprintf(text, sizeof text,
                      "<mujoco><option gravity='0 0 0' timestep='%g'/><default><geom condim='1' solref='%g %g' solimp='.9 .9 "
                      ".001'/></default>"
                      "<worldbody><geom type='plane' size='1 1 1'/><body pos='0 0 .05'><joint type='slide' axis='1 0 "
                      "0'/><joint type='slide' axis='0 1 0'/><joint type='slide' axis='0 0 1'/>"
                      "<geom type='sphere' size='.05' mass='1'/></body></worldbody></mujoco>",
                      1 / rate, -1e3 * kStiffness, -1e3 * kDamping);
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "wall.xml", size);
    std::memcpy(files->filedata[mj_findFileVFS(files.get(), "wall.xml")], text, static_cast<std::size_t>(size));
    char fault[500] = "";
    model_.reset(mj_loadXML("wall.xml", files.get(), fault, sizeof fault));
    mj_deleteVFS(files.get());
    if (!model_) throw std::runtime_error(fault);
    data_.reset(mj_makeData(model_.get()));
  }

  double force(double z) {
    data_->qpos[2] = 1e-3 * z;
    data_->qvel[2] = difference_.of(z);
    mj_forward(model_.get(), data_.get());
    mjtNum force[6] = {};
    if (data_->ncon > 0) mj_contactForce(model_.get(), data_.get(), 0, force);
    return force[0];
  }

 private:
  struct Free {
    void operator()(mjModel* its) const { mj_deleteModel(its); }
    void operator()(mjData* its) const { mj_deleteData(its); }
  };
  Difference difference_;
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
};
#endif

template <class Engine>
Damper engine(double rate) {
  return [its = std::make_shared<Engine>(rate)](double z) { return its->force(z); };
}

std::vector<double> forces_along(const Damper& damper, const std::vector<double>& path) {
  std::vector<double> forces(path.size());
  std::ranges::transform(path, forces.begin(), damper);
  return forces;
}

double spring(double z) {
  return std::max(0.0, -kStiffness * z);
}

// 1 kHz: from 3 mm above to 2 mm below at 100 mm/s, 40 ms there, and back.
std::vector<double> in_and_out() {
  std::vector<double> path;
  for (int i = 0; i < 50; ++i) path.push_back(3.03 - 0.1 * i);
  path.insert(path.end(), 40, path.back());
  for (int i = 49; i >= 0; --i) path.push_back(3.03 - 0.1 * i);
  return path;
}

// The peak to peak of what is added to the spring, at 1 kHz, 1 mm/s inward, in counts of 0.03 mm; without the beginning.
double noise(const MakeDamper& make) {
  const Damper damper = make(1000);
  double least = 1e9, most = -1e9;
  for (int i = 0; i < 2000; ++i) {
    const double z = -0.03 * std::round((1 + 0.001 * i) / 0.03), added = damper(z) - spring(z);
    if (i < 500) continue;
    least = std::min(least, added);
    most = std::max(most, added);
  }
  return most - least;
}

// The energy for the hand, beside the spring's, in a swing of 1 mm, 2 mm below the surface, sampled at 200 Hz; mJ.
double energy(const MakeDamper& make, double hertz) {
  constexpr int kRate = 200, kSeconds = 10;
  const Damper damper = make(kRate);
  const auto place = [&](int i) { return -2 + std::cos(2 * std::numbers::pi * hertz * i / kRate); };
  double sum = 0;
  for (int i = 0; i < 2 * kSeconds * kRate; ++i) {
    const double added = damper(place(i)) - spring(place(i));
    if (i >= kSeconds * kRate) sum += added * (place(i + 1) - place(i));
  }
  return sum / (kSeconds * hertz);
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::pair<std::string, MakeDamper>> dampers{
      {"forceshade (share 1)", [](double rate) { return forceshade_damper(rate, 1); }},
      {"forceshade (9 ms)", [](double rate) { return forceshade_damper(rate, static_cast<float>(1 / (1 + 0.009 * rate))); }},
      {"CHAI3D 3.3.0 (by its sources)", chai3d_damper},
      {"Bullet", engine<Bullet>},
#ifdef HAS_MUJOCO
      {"MuJoCo", engine<Mujoco>},
#endif
  };
  const std::vector<double> path = in_and_out();
  std::vector<std::vector<double>> all;
  std::printf("| | step, N | pull, N | in the air, N | noise, N | 10 Hz, mJ | 30 Hz, mJ |\n|---|---|---|---|---|---|---|\n");
  for (const auto& [name, make] : dampers) {
    all.push_back(forces_along(make(1000), path));
    const std::vector<double>& forces = all.back();
    double air = 0;
    for (std::size_t i = 0; i < path.size(); ++i)
      if (path[i] > 0) air = std::max(air, std::abs(forces[i]));
    const auto landing = static_cast<std::size_t>(std::ranges::find_if(path, [](double z) { return z < 0; }) - path.begin());
    std::printf("| %s | %.3f | %.3f | %.3f | %.4f | %.3f | %.3f |\n", name.c_str(), forces[landing] - spring(path[landing]),
                std::max(0.0, -std::ranges::min(forces)), air, noise(make), energy(make, 10), energy(make, 30));
  }
  if (count < 2) return 0;
  std::FILE* file = std::fopen(arguments[1], "w");
  if (file == nullptr) return 1;
  std::fprintf(file, "t_ms,z_mm,the spring alone");
  for (const auto& [name, make] : dampers) std::fprintf(file, ",\"%s\"", name.c_str());
  for (std::size_t i = 0; i < path.size(); ++i) {
    std::fprintf(file, "\n%zu,%.2f,%.3f", i, path[i], spring(path[i]));
    for (const auto& forces : all) std::fprintf(file, ",%.4f", forces[i]);
  }
  std::fprintf(file, "\n");
  return std::fclose(file) == 0 ? 0 : 1;
}
