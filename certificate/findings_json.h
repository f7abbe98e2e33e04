// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Findings as JSON, of which both a certificate and the result of a unit of work are made: written, and read by the same keys.
// A reader of one looks at the numbers alone, and leaves its caller to say what they have to be and to end() the object.

#include <nlohmann/json.hpp>

#include "certificate/json_fields.h"
#include "forceshade/certificate.h"

namespace forceshade::properties {

inline nlohmann::ordered_json json_of(const PropertyResult& result) {
  return {{"name", result.name}, {"cases", result.cases}, {"held", result.held}, {"counterexample", result.counterexample}};
}
inline PropertyResult property_from(Fields& fields) {
  return {fields.text("name"), fields.count("cases"), fields.flag("held"), fields.text("counterexample", true)};
}

inline nlohmann::ordered_json json_of(const LoopEnergy& loop) {
  return {{"depth_mm", loop.depth_mm},
          {"bound_mJ", loop.bound_mJ},
          {"witness_mJ", loop.witness_mJ},
          {"measured_mJ", loop.measured_mJ}};
}
inline LoopEnergy loop_from(Fields& fields) {
  return {fields.number("depth_mm"), fields.interval("bound_mJ"), fields.number("witness_mJ"), fields.number("measured_mJ")};
}

inline nlohmann::ordered_json json_of(const ClosestCall& call) {
  return {{"x_mm", static_cast<double>(call.x)},
          {"y_mm", static_cast<double>(call.y)},
          {"z_mm", static_cast<double>(call.z)},
          {"ulps_from_tie", call.ulps_from_tie}};
}
inline ClosestCall call_from(Fields& fields) {
  return {fields.binary32("x_mm"), fields.binary32("y_mm"), fields.binary32("z_mm"), fields.number("ulps_from_tie")};
}

}  // namespace forceshade::properties
