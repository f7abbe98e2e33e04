// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Encodes and decodes the Inverse Service's JSON messages; opens no socket. Its lengths are in m; those of these structures
// are in mm. Its axes are the laws': x right, y away from the user, z up.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace forceshade::device::haply {

struct Version {
  int major = 0, minor = 0;
  std::string text;  // "3.5.1"

  // Since 3.5 a force is written as `vector`, before as `values`, and only since then the basis is configured with the session.
  bool is_new() const noexcept { return minor >= 5; }
};

// From the answer to GET /version. Throws Error where it has no version, and for versions that are not spoken here:
// expected is 3.1 or later, below 4.
Version version_of(const std::string& answer);

// The number of sessions that the answer to GET /sessions lists, if it is such a list.
std::optional<std::size_t> sessions_in(const std::string& answer);
// The warning where ours is not the only one of these; empty otherwise.
std::string words_of_other_sessions(std::optional<std::size_t> sessions);

// An Inverse3 in a message of the service. What the message leaves out is empty.
struct Inverse3 {
  // Its configuration, which only the first message and a full state have.
  std::string id, type, serial, firmware, handedness, basis;
  std::optional<bool> gravity_compensation;
  std::optional<double> gate_gain, damping;
  // Its mount, or the transform of its state, where that is not the identity: the first that turns, shifts or scales positions
  // and forces, in words.
  std::string altered;
  // Its state.
  std::optional<Eigen::Vector3d> position;  // mm
  std::optional<Eigen::Vector3d> force;     // N: that the service says it applies
  bool calibrated = false, in_use = false;
  bool powered = true, ready = true;
};

struct Message {
  std::vector<Inverse3> arms;
  std::uint16_t buttons = 0;  // of the first grip that the message lists; none of one that sleeps
  bool has_grip = false;
};

// Throws Error for what is no message of the service, and for a number that is not finite or beyond all reach.
Message message_of(std::string_view text);

// The only arm, or that whose id or serial number this is. Throws Error where none is to be chosen.
const Inverse3& chosen(const Message& message, const std::string& name);

// The first message of a session: who this is, and the basis of the laws; answered with a full state.
std::string configuration(const Version& version);
// After it the service sends the configuration of all devices again.
std::string full_state();

// A frame: a force in N, or, for a run without forces, no command but to measure.
class Frames {
 public:
  Frames(const Version& version, const std::string& id);

  std::string with_force(const Eigen::Vector3d& force) const;
  const std::string& without_force() const noexcept { return probe_; }

 private:
  std::string begin_, probe_;
};

}  // namespace forceshade::device::haply
