// SPDX-License-Identifier: BSD-3-Clause
// Readings beside those of a frame: versions, forces, velocities, joints and encoders. The joints are invented, since no
// document has those of a device: each of three turns with one axis, by 1 rad for 0.1 m, and a wrist or a gripper rests at 0.

#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "stand_in.h"

enum { kJoints = 8, kMoved = 3 };
static const double kReach = 0.1;      // m for 1 rad of a joint
static const double kCounts = 10000;   // of an encoder for 1 rad
static const double kArmsMass = 0.09;  // kg, of which the hand's is not part
static const double kDegrees = 180 / 3.14159265358979323846;

static int encoder_of(double metres) {
  return (int)lround(metres / kReach * kCounts);
}

// Begins a call that answers with so many numbers, all 0; false where it has failed.
static bool begins(const char* function, signed char id, bool is_for_experts, void* numbers, size_t size) {
  if (!(is_for_experts ? expert_call_begins : call_begins)(function, id)) return false;
  if (numbers) {
    memset(numbers, 0, size);
    return true;
  }
  fault(FAULT_NULL, "%s", function);
  call_ends(-1, ERROR_NULL);
  return false;
}

static int three(const char* function, double* a, double* b, double* c, const double is[3], signed char id,
                 bool is_for_experts) {
  if (!begins(function, id, is_for_experts, a && b && c ? a : NULL, sizeof *a)) return -1;
  *a = is[0];
  *b = is[1];
  *c = is[2];
  return call_ends(0, ERROR_NONE);
}

static int one(const char* function, double* value, double is, signed char id) {
  if (!begins(function, id, false, value, sizeof *value)) return -1;
  *value = is;
  return call_ends(0, ERROR_NONE);
}

static const double kRest[3] = {0, 0, 0};

PUBLISHED void dhdGetSDKVersion(int* major, int* minor, int* release, int* revision) {
  lock();
  if (major) *major = 3;
  if (minor) *minor = 17;
  if (release) *release = 6;
  if (revision) *revision = 0;
  unlock();
}

// The firmware's.
PUBLISHED int dhdGetVersion(double* version, signed char id) {
  return one("dhdGetVersion", version, 3.1, id);
}

PUBLISHED int dhdGetComponentVersionStr(unsigned component, char* text, size_t size, signed char id) {
  if (!begins("dhdGetComponentVersionStr", id, false, size > 0 ? text : NULL, size)) return -1;
  snprintf(text, size, "3.1.0");
  (void)component;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetSystemRev(signed char id) {
  if (!call_begins("dhdGetSystemRev", id)) return -1;
  return call_ends(1, ERROR_NONE);
}

PUBLISHED int dhdCheckControllerMemory(signed char id) {
  if (!call_begins("dhdCheckControllerMemory", id)) return -1;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetPositionAndOrientationRad(double* x, double* y, double* z, double* a, double* b, double* c,
                                              signed char id) {
  return read_position("dhdGetPositionAndOrientationRad", x, y, z, a, b, c, NULL, id);
}

PUBLISHED int dhdGetPositionAndOrientationDeg(double* x, double* y, double* z, double* a, double* b, double* c,
                                              signed char id) {
  return read_position("dhdGetPositionAndOrientationDeg", x, y, z, a, b, c, NULL, id);
}

PUBLISHED int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double matrix[3][3], signed char id) {
  double unused = 0;
  double* const angle = matrix ? &unused : NULL;
  return read_position("dhdGetPositionAndOrientationFrame", x, y, z, angle, angle, angle, matrix, id);
}

// The force that acts; a torque or a force of the gripper is never given.
static int forces(const char* function, double* const all[7], int count, signed char id) {
  if (!call_begins(function, id)) return -1;
  for (int i = 0; i < count; ++i)
    if (!all[i]) {
      fault(FAULT_NULL, "%s", function);
      return call_ends(-1, ERROR_NULL);
    }
  for (int i = 0; i < count; ++i) *all[i] = i < 3 ? state->arm.force[i] : 0;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetForce(double* x, double* y, double* z, signed char id) {
  return forces("dhdGetForce", (double* [7]){x, y, z}, 3, id);
}

PUBLISHED int dhdGetForceAndTorque(double* x, double* y, double* z, double* a, double* b, double* c, signed char id) {
  return forces("dhdGetForceAndTorque", (double* [7]){x, y, z, a, b, c}, 6, id);
}

PUBLISHED int dhdGetForceAndTorqueAndGripperForce(double* x, double* y, double* z, double* a, double* b, double* c,
                                                  double* gripper, signed char id) {
  return forces("dhdGetForceAndTorqueAndGripperForce", (double* [7]){x, y, z, a, b, c, gripper}, 7, id);
}

PUBLISHED int dhdGetAngularVelocityRad(double* a, double* b, double* c, signed char id) {
  return three("dhdGetAngularVelocityRad", a, b, c, kRest, id, false);
}

PUBLISHED int dhdGetAngularVelocityDeg(double* a, double* b, double* c, signed char id) {
  return three("dhdGetAngularVelocityDeg", a, b, c, kRest, id, false);
}

PUBLISHED int dhdGetGripperLinearVelocity(double* value, signed char id) {
  return one("dhdGetGripperLinearVelocity", value, 0, id);
}

PUBLISHED int dhdGetGripperAngularVelocityRad(double* value, signed char id) {
  return one("dhdGetGripperAngularVelocityRad", value, 0, id);
}

PUBLISHED int dhdGetGripperAngularVelocityDeg(double* value, signed char id) {
  return one("dhdGetGripperAngularVelocityDeg", value, 0, id);
}

static int finger(const char* function, double side, double* x, double* y, double* z, signed char id) {
  if (!begins(function, id, false, x && y && z ? x : NULL, sizeof *x)) return -1;
  if (!has_gripper()) return call_ends(-1, ERROR_NOT_AVAILABLE);
  *x = state->last_read[0];
  *y = state->last_read[1] + side * kGap / 2;
  *z = state->last_read[2];
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetGripperThumbPos(double* x, double* y, double* z, signed char id) {
  return finger("dhdGetGripperThumbPos", -1, x, y, z, id);
}

PUBLISHED int dhdGetGripperFingerPos(double* x, double* y, double* z, signed char id) {
  return finger("dhdGetGripperFingerPos", 1, x, y, z, id);
}

// Joints, in expert mode. Those of the wrist and of the gripper rest at 0.
PUBLISHED int dhdGetJointAngles(double joints[kJoints], signed char id) {
  if (!begins("dhdGetJointAngles", id, true, joints, kJoints * sizeof *joints)) return -1;
  for (int i = 0; i < kMoved; ++i) joints[i] = state->arm.position[i] / kReach;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetJointVelocities(double joints[kJoints], signed char id) {
  if (!begins("dhdGetJointVelocities", id, true, joints, kJoints * sizeof *joints)) return -1;
  for (int i = 0; i < kMoved; ++i) joints[i] = state->arm.velocity[i] / kReach;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetJointAngleRange(double least[kJoints], double most[kJoints], signed char id) {
  if (!begins("dhdGetJointAngleRange", id, true, most ? least : NULL, kJoints * sizeof *least)) return -1;
  memset(most, 0, kJoints * sizeof *most);
  for (int i = 0; i < kMoved; ++i) most[i] = -(least[i] = -1.5);
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdJointAnglesToInertiaMatrix(const double joints[kJoints], double inertia[6][6], signed char id) {
  if (!begins("dhdJointAnglesToInertiaMatrix", id, true, joints ? inertia : NULL, 36 * sizeof(double))) return -1;
  for (int i = 0; i < kMoved; ++i) inertia[i][i] = kArmsMass;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetDeltaJointAngles(double* a, double* b, double* c, signed char id) {
  const double* const at = state->arm.position;
  return three("dhdGetDeltaJointAngles", a, b, c, (double[3]){at[0] / kReach, at[1] / kReach, at[2] / kReach}, id, true);
}

PUBLISHED int dhdGetWristJointAngles(double* a, double* b, double* c, signed char id) {
  return three("dhdGetWristJointAngles", a, b, c, kRest, id, true);
}

static int jacobian(const char* function, double matrix[3][3], double diagonal, signed char id) {
  if (!begins(function, id, true, matrix, 9 * sizeof(double))) return -1;
  for (int i = 0; i < 3; ++i) matrix[i][i] = diagonal;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetDeltaJacobian(double matrix[3][3], signed char id) {
  return jacobian("dhdGetDeltaJacobian", matrix, kReach, id);
}

PUBLISHED int dhdGetWristJacobian(double matrix[3][3], signed char id) {
  return jacobian("dhdGetWristJacobian", matrix, 1, id);
}

PUBLISHED int dhdDeltaJointAnglesToJacobian(double a, double b, double c, double matrix[3][3], signed char id) {
  (void)a, (void)b, (void)c;
  return jacobian("dhdDeltaJointAnglesToJacobian", matrix, kReach, id);
}

PUBLISHED int dhdDeltaEncodersToJointAngles(int a, int b, int c, double* x, double* y, double* z, signed char id) {
  return three("dhdDeltaEncodersToJointAngles", x, y, z, (double[3]){a / kCounts, b / kCounts, c / kCounts}, id, true);
}

PUBLISHED int dhdDeltaEncoderToPosition(int a, int b, int c, double* x, double* y, double* z, signed char id) {
  const double step = kReach / kCounts;
  return three("dhdDeltaEncoderToPosition", x, y, z, (double[3]){a * step, b * step, c * step}, id, true);
}

static int three_encoders(const char* function, int* a, int* b, int* c, const double metres[3], signed char id) {
  if (!begins(function, id, true, a && b && c ? a : NULL, sizeof *a)) return -1;
  *a = encoder_of(metres[0]);
  *b = encoder_of(metres[1]);
  *c = encoder_of(metres[2]);
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetDeltaEncoders(int* a, int* b, int* c, signed char id) {
  return three_encoders("dhdGetDeltaEncoders", a, b, c, state->arm.position, id);
}

PUBLISHED int dhdGetWristEncoders(int* a, int* b, int* c, signed char id) {
  return three_encoders("dhdGetWristEncoders", a, b, c, kRest, id);
}

PUBLISHED int dhdDeltaPositionToEncoder(double x, double y, double z, int* a, int* b, int* c, signed char id) {
  return three_encoders("dhdDeltaPositionToEncoder", a, b, c, (double[3]){x, y, z}, id);
}

PUBLISHED int dhdDeltaJointAnglesToEncoders(double x, double y, double z, int* a, int* b, int* c, signed char id) {
  return three_encoders("dhdDeltaJointAnglesToEncoders", a, b, c, (double[3]){x * kReach, y * kReach, z * kReach}, id);
}

PUBLISHED int dhdGetGripperEncoder(int* encoder, signed char id) {
  if (!begins("dhdGetGripperEncoder", id, true, encoder, sizeof *encoder)) return -1;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdUpdateEncoders(signed char id) {
  if (!expert_call_begins("dhdUpdateEncoders", id)) return -1;
  return call_ends(0, ERROR_NONE);
}

// The encoders that the mask names.
PUBLISHED int dhdGetEnc(int encoders[kJoints], unsigned char mask, signed char id) {
  if (!begins("dhdGetEnc", id, true, encoders, kJoints * sizeof *encoders)) return -1;
  for (int i = 0; i < kMoved; ++i)
    if (mask >> i & 1) encoders[i] = encoder_of(state->arm.position[i]);
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetEncoder(int index, signed char id) {
  if (!expert_call_begins("dhdGetEncoder", id)) return -1;
  if (index >= 0 && index < kJoints) return call_ends(index < kMoved ? encoder_of(state->arm.position[index]) : 0, ERROR_NONE);
  fault(FAULT_RANGE, "dhdGetEncoder: %d", index);
  return call_ends(-1, ERROR_INVALID);
}

PUBLISHED int dhdGetEncRange(int least[kJoints], int most[kJoints], signed char id) {
  if (!begins("dhdGetEncRange", id, true, most ? least : NULL, kJoints * sizeof *least)) return -1;
  memset(most, 0, kJoints * sizeof *most);
  for (int i = 0; i < kMoved; ++i) most[i] = -(least[i] = -(int)(1.5 * kCounts));
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetEncVelocities(double velocities[kJoints], signed char id) {
  if (!begins("dhdGetEncVelocities", id, true, velocities, kJoints * sizeof *velocities)) return -1;
  for (int i = 0; i < kMoved; ++i) velocities[i] = state->arm.velocity[i] / kReach * kCounts;
  return call_ends(0, ERROR_NONE);
}

// The angles of the base, which turn gravity and nothing else here.
static int base_angle(const char* function, double* value, int axis, double unit, signed char id) {
  if (!begins(function, id, false, value, sizeof *value)) return -1;
  *value = state->base_angle[axis] * unit;
  return call_ends(0, ERROR_NONE);
}

static int set_base_angle(const char* function, double value, int axis, double unit, signed char id) {
  if (!call_begins(function, id)) return -1;
  if (!isfinite(value)) {
    fault(FAULT_NOT_FINITE, "%s", function);
    return call_ends(-1, ERROR_INVALID);
  }
  state->base_angle[axis] = value / unit;
  return call_ends(0, ERROR_NONE);
}

#define BASE_ANGLE(NAME, AXIS, UNIT)                              \
  PUBLISHED int dhdGet##NAME(double* value, signed char id) {     \
    return base_angle("dhdGet" #NAME, value, AXIS, UNIT, id);     \
  }                                                               \
  PUBLISHED int dhdSet##NAME(double value, signed char id) {      \
    return set_base_angle("dhdSet" #NAME, value, AXIS, UNIT, id); \
  }
BASE_ANGLE(BaseAngleXRad, 0, 1)
BASE_ANGLE(BaseAngleXDeg, 0, kDegrees)
BASE_ANGLE(BaseAngleZRad, 1, 1)
BASE_ANGLE(BaseAngleZDeg, 1, kDegrees)
BASE_ANGLE(DeviceAngleRad, 0, 1)
BASE_ANGLE(DeviceAngleDeg, 0, kDegrees)

// The keyboard, which is standard input.
PUBLISHED bool dhdKbHit(void) {
  struct pollfd input = {.fd = STDIN_FILENO, .events = POLLIN};
  return poll(&input, 1, 0) == 1 && (input.revents & POLLIN) != 0;
}

PUBLISHED char dhdKbGet(void) {
  char letter = 0;
  return read(STDIN_FILENO, &letter, 1) == 1 ? letter : 0;
}
