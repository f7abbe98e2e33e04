// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/vectors.h"

#include <array>
#include <bit>
#include <cmath>
#include <set>
#include <stdexcept>

#include "properties/conformance/scene.h"
#include "properties/conformance/strokes.h"
#include "rendering/breakdown.h"
#include "text/formatted.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;
using properties::Aim;

constexpr unsigned kVectorDigits = 40;

Json bits(const Eigen::Vector3f& numbers) {
  Json all = Json::array();
  for (const float number : numbers) all.push_back(formatted("%08x", std::bit_cast<std::uint32_t>(number)));
  return all;
}

Json case_json(std::uint64_t id, const properties::Aimed& aimed, const std::optional<std::uint32_t>& periods,
               const reference::Rounded& exact, const std::optional<std::array<std::string, 3>>& digits) {
  Json json{{"id", id}, {"flag", std::string(name_of(aimed.aim))}};
  if (periods) json["periods"] = *periods;
  json.update({{"status", std::string(properties::kStatusNames[static_cast<std::size_t>(exact.status)])},
               {"position_mm", hexfloats({aimed.position.data(), 3})},
               {"force_N", hexfloats({exact.force.data(), 3})}});
  if (digits) json["exact_force_N"] = *digits;
  json["position_bits"] = bits(aimed.position);
  json["force_bits"] = bits(exact.force);
  return json;
}

// The head with the key "paths", in which each case is a line.
std::string with_lines_of_cases(const Json& head, const Json& paths) {
  std::string text = head.dump(1, ' ', true, Json::error_handler_t::replace);
  text.erase(text.rfind('\n'));
  text += ",\n \"paths\": [";
  for (const Json& path : paths) {
    text += &path == &paths.front() ? "\n  [" : ",\n  [";
    for (const Json& each : path) text += (&each == &path.front() ? "\n   " : ",\n   ") + each.dump();
    text += "\n  ]";
  }
  return text + "\n ]\n}\n";
}

}  // namespace

Json json_of(const damping::Parameters& p) {
  const auto number = [](float parameter) { return std::isinf(parameter) ? Json() : Json(static_cast<double>(parameter)); };
  return {{"rate_Hz", number(p.rate)}, {"share", number(p.share)}, {"damping", number(p.damping)},
          {"most", number(p.most)},    {"drag", number(p.drag)},   {"full_at", number(p.full_at)}};
}

Flag flag_of(Aim aim) {
  switch (aim) {
    case Aim::any_bits:
      return {"Any bits: NaN, infinities, subnormal and huge numbers, which a renderer has to answer with no force.",
              {"jrouwe/JoltPhysics#1340", "jrouwe/JoltPhysics#1564", "tommy-xr/shock2quest#507"}};
    case Aim::volume:
      return {"Somewhere in or above the surface.", {"google-deepmind/mujoco#2206", "libnifalcon/libnifalcon#3"}};
    case Aim::surface:
      return {"Within some units in the last place of the surface, where contact begins.",
              {"flexible-collision-library/fcl#375", "flexible-collision-library/fcl#495", "RobotLocomotion/drake#10747"}};
    case Aim::facet_line:
      return {
          "On or beside a line where two facets meet, or a vertex of a mesh: no force may come from the edge of a flat "
          "surface.",
          {"dimforge/rapier#95", "bulletphysics/bullet3#288", "bulletphysics/bullet3#676", "raisimTech/raisimLib#161"}};
    case Aim::quantum:
      return {"Coordinates about 2^-30 mm, below which a coordinate counts as zero.",
              {"implicit-invocation/jbump#4", "CesiumGS/cesium-unreal#1465"}};
    case Aim::domain_end:
      return {"About 10000 mm, beyond which there is no force.",
              {"dimforge/parry#407", "godotengine/godot#79592", "schteppe/cannon.js#127"}};
    case Aim::tie:
      return {"The exact force is as near as possible to the middle of two binary32 numbers.",
              {"microsoft/STL#2366", "fastfloat/fast_float#300"}};
    case Aim::axis:
      return {"On or beside the axis of the bump, or a position that moved along one axis alone.",
              {"jrouwe/JoltPhysics#227", "DanielChappuis/reactphysics3d#32"}};
    default:
      return {"Coordinates with few bits, at which exact ties are frequent.",
              {"gkjohnson/three-mesh-bvh#169", "mikedh/trimesh#73"}};
  }
}

std::string vectors_of(const Description& description, std::uint64_t count, std::uint64_t seed, const Monitor& monitor,
                       const std::optional<damping::Parameters>& damping) {
  const auto subject = properties::subject_of(description);
  Strokes ticks(subject->positions(seed), damping.has_value(), seed);
  auto session = subject->open_reference();
  std::optional<reference::Damping> damper;
  if (damping) damper = std::get<reference::Damping>(reference::Damping::build(*damping));
  const bool remembers = damping || !subject->renderer().batch;
  std::set<Aim> seen;
  Json paths = Json::array({Json::array()});
  const auto begin_a_path = [&] {
    if (!paths.back().empty()) paths.push_back(Json::array());
    session = subject->open_reference();
    if (damper) damper->reset();
  };
  for (std::uint64_t id = 1; id <= count; ++id) {
    monitor.at(static_cast<double>(id) / static_cast<double>(count));
    if (remembers && paths.back().size() >= kVectorPath) begin_a_path();
    const auto [aimed, periods] = ticks.next();
    try {
      reference::Rounded exact = session->step(aimed.position);
      if (exact.status == Status::unfinished) {
        begin_a_path();
        continue;
      }
      if (damper) {
        exact = damper->tick(aimed.position, periods, exact);
        paths.back().push_back(case_json(id, aimed, periods, exact, std::nullopt));
      } else {
        paths.back().push_back(case_json(id, aimed, std::nullopt, exact, session->decimal(kVectorDigits)));
      }
      seen.insert(aimed.aim);
    } catch (const std::domain_error&) {
      begin_a_path();
    }
  }
  if (paths.back().empty()) paths.erase(paths.size() - 1);
  Json flags = Json::object();
  for (const Aim aim : seen) {
    const Flag flag = flag_of(aim);
    flags[std::string(name_of(aim))] = {{"meaning", flag.meaning}, {"threads", flag.threads}};
  }
  Json head{{"schema", "forceshade vectors 1"}, {"licence", "CC0-1.0"}, {"subject", scene_of(description)}};
  if (damping) head["damping"] = json_of(*damping);
  head.update({{"seed", seed}, {"flags", flags}});
  return with_lines_of_cases(head, paths);
}

}  // namespace forceshade::conformance
