// SPDX-License-Identifier: BSD-3-Clause
// The lines of a renderer or a simulator: a hello in the first line, and answers to so many positions or forces in each other
// one.
#include <algorithm>
#include <sstream>
#include <vector>

#include "files/json_line.h"
#include "properties/conformance/doors/dialogue.h"
#include "properties/conformance/doors/process_door.h"
#include "properties/conformance/scene_renderer.h"
#include "properties/conformance/simulators/course.h"
#include "properties/conformance/simulators/simulator_process.h"
#include "tests/fuzz/input_file.h"

namespace {

using namespace forceshade;
using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestMessage = 2000;

void require_message(const std::string& words) {
  fuzz::require(!words.empty() && words.size() <= kLongestMessage, "a message is short: " + std::to_string(words.size()));
  fuzz::require(std::ranges::none_of(words, [](unsigned char c) { return c < ' ' || c == 127; }), "a message can be shown");
}

template <class Read>
void read_or_fail(const Read& read) {
  try {
    read();
  } catch (const files::ProcessFailed& failure) {
    require_message(failure.what());
  }
}

// A renderer that answers with this line.
class Written final : public conformance::RendererUnderTest {
 public:
  Written(const conformance::Hello& hello, const std::string& line) : hello_(hello), line_(line) {}
  const conformance::Hello& hello() const override { return hello_; }
  std::vector<Eigen::Vector3f> answers(std::span<const Eigen::Vector3f> positions, bool,
                                       std::span<const std::uint32_t>) override {
    return conformance::answers_in(line_, positions.size());
  }
  void say_goodbye() override {}

 private:
  conformance::Hello hello_;
  std::string line_;
};

const Json kLaw{{"kind", "law"}};
const Json kMesh{{"kind", "mesh"}, {"parameters", {{"sides", "front"}, {"shading", "none"}}}};

void read_as_renderer(const std::string& hello, const std::vector<std::string>& lines, const Json& scene) {
  const conformance::Hello its = conformance::hello_of(files::object_in(hello, "renderer"), scene);
  if (its.refusal) return require_message(*its.refusal);
  fuzz::require(its.domain >= 1 && its.domain <= 10'000, "a domain is within its bounds");
  fuzz::require(its.answer != conformance::Answer::impulse || its.rate, "an impulse has a rate");
  for (const std::string& line : lines)
    read_or_fail([&] {
      for (const std::size_t count : {1U, 2U}) {
        conformance::SceneRenderer renderer(std::make_unique<Written>(its, line), 0.5F);
        const auto forces = renderer.forces(std::vector<Eigen::Vector3f>(count, {1, 2, -3}), true);
        fuzz::require(forces.size() == count, "each position has a force");
      }
    });
}

void read_as_simulator(const std::string& hello, const std::vector<std::string>& lines) {
  namespace simulators = conformance::simulators;
  const auto its = simulators::capabilities_of(files::object_in(hello, "simulator"));
  if (its.refusal) return require_message(*its.refusal);
  fuzz::require(its.smallest_radius >= 0 && its.speed_cap.value_or(0) >= 0, "a size is not negative");
  for (const std::string& line : lines)
    read_or_fail([&] {
      const simulators::Simulation scene = simulators::resting_on({}).scene;
      const auto motion = simulators::motion_in(files::object_in(line, "simulator"), its.reports, scene, 1);
      if (motion.refusal) return require_message(*motion.refusal);
      fuzz::require(motion.states.size() == 1, "each force has a state");
      fuzz::require(motion.states[0].contacts.empty() || its.reports != simulators::SimulatorCapabilities::Reports::nothing,
                    "what reports nothing has no contacts");
    });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream in{std::string(fuzz::text_of(data, size))};
  std::string hello;
  std::getline(in, hello);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  for (const Json& scene : {kLaw, kMesh}) read_or_fail([&] { read_as_renderer(hello, lines, scene); });
  read_or_fail([&] { read_as_simulator(hello, lines); });
  return 0;
}
