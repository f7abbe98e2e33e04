// SPDX-License-Identifier: BSD-3-Clause
// The functions that a client calls in each frame: readings and forces.

#define _GNU_SOURCE
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "stand_in.h"

enum { kTimeGuardResult = 1, kSaturatedResult = 2 };

static bool any_null(const char* function, const double* a, const double* b, const double* c) {
  if (a && b && c) return false;
  fault(FAULT_NULL, "%s", function);
  return true;
}

static void take_time(void) {
  const double micros = number_chosen(CALL_TIME);
  if (micros > 0) usleep((useconds_t)micros);
}

static void spoil(double position[3]) {
  if (take_pending(EVENT_NAN)) position[1] = NAN;
  if (take_pending(EVENT_GARBAGE)) position[1] = 1e30;
  if (take_pending(EVENT_WRONG_UNIT))
    for (int i = 0; i < 3; ++i) position[i] = 1000 * position[i] + 1;
  if (take_pending(EVENT_JUMP)) position[1] += 0.05;
}

int read_position(const char* function, double* x, double* y, double* z, double* a, double* b, double* c, double matrix[3][3],
                  signed char id) {
  if (!call_begins(function, id)) return -1;
  if (any_null(function, x, y, z) || any_null(function, a, b, c)) return call_ends(-1, ERROR_NULL);
  struct session* const it = session();
  if (number_chosen(CLOCK) > 0) arm_advance(&state->arm, 1 / number_chosen(CLOCK));
  events_at(++it->readings, device_happen);
  if (it->readings == 300) note("settling");
  if (it->contact_forces >= 100 && !state->was_in_contact) {
    state->was_in_contact = true;
    events_at(0, device_happen);
  }
  it->since_reading = 0;
  take_time();
  if (take_pending(EVENT_LATE)) usleep(100000);
  if (take_pending(EVENT_READ_ERROR) || (!state->plugged && is_chosen(UNPLUGGED, "error"))) return call_ends(-1, ERROR_COM);
  const bool is_guarded = now_ns() - state->last_read_ns < INT64_C(1000) * state->time_guard_us;
  const bool is_old = is_guarded || take_pending(EVENT_TIME_GUARD);
  if (!is_old && state->plugged) {
    memcpy(state->last_read, state->arm.position, sizeof state->last_read);
    state->last_read_ns = now_ns();
  }
  double position[3];
  memcpy(position, state->last_read, sizeof position);
  spoil(position);
  *a = *b = *c = 0;
  *x = position[0];
  *y = position[1];
  *z = position[2];
  for (int i = 0; matrix && i < 9; ++i) matrix[i / 3][i % 3] = i % 4 == 0;
  return call_ends(is_old ? kTimeGuardResult : 0, ERROR_NONE);
}

PUBLISHED int dhdGetPosition(double* x, double* y, double* z, signed char id) {
  double unused = 0;
  return read_position("dhdGetPosition", x, y, z, &unused, &unused, &unused, NULL, id);
}

// Judges it; false where it cannot be carried out, and `error` says why.
static bool may_command(const double force[3], int* error) {
  struct session* const it = session();
  const int64_t now = now_ns();
  const int64_t last = it->last_force_ns > it->enabled_ns ? it->last_force_ns : it->enabled_ns;
  const double gap = (double)(now - last) / 1e6;
  if (last > 0 && state->forces_on && state->plugged) {
    it->longest_gap_ms = fmax(it->longest_gap_ms, gap);
    if (gap > number_chosen(LONGEST_GAP)) fault(FAULT_GAP, "%.1f ms", gap);
  }
  if (it->thread == 0) it->thread = gettid();
  if (it->thread != gettid()) fault(FAULT_TWO_THREADS, "%s", "");
  if (++it->since_reading == 100) fault(FAULT_BLIND, "%s", "");
  ++it->forces;
  it->last_force_ns = now;
  if (it->forces == 1) note("commanded");
  *error = ERROR_INVALID;
  if (!isfinite(force[0]) || !isfinite(force[1]) || !isfinite(force[2])) {
    fault(FAULT_NOT_FINITE, "%s", "");
    memset(state->commanded, 0, sizeof state->commanded);
    return is_chosen(NOT_FINITE, "accept");
  }
  const double size = length(force);
  if (size > 0) {
    if (size > number_chosen(MOST_FORCE)) fault(FAULT_ABSURD, "%.6g N", size);
    if (it->readings == 0) fault(FAULT_FORCE_FIRST, "%s", "");
    if (state->reset) fault(FAULT_UNCALIBRATED, "%s", "");
    if (!state->plugged && now - state->unplugged_ns > 100000000) fault(FAULT_AFTER_UNPLUG, "%s", "");
    if (!state->forces_on && state->cut_ns == 0) fault(FAULT_NOT_ENABLED, "%s", "");
    if (!state->forces_on && state->cut_ns > 0 && now - state->cut_ns > 100000000) fault(FAULT_AFTER_CUT, "%s", "");
  }
  *error = ERROR_NOT_ENABLED;
  return state->forces_on || is_chosen(SET_FORCE_OFF, "ok");
}

static void count_contact(double before, double size) {
  struct session* const it = session();
  it->largest_force = fmax(it->largest_force, size);
  if (size > small()) ++it->contact_forces;
  if ((before > small()) != (size > small())) note(size > small() ? "contact" : "free");
}

static int command(double x, double y, double z) {
  const double force[3] = {x, y, z};
  int error = ERROR_NONE;
  take_time();
  if (!may_command(force, &error)) return call_ends(-1, error);
  if (!isfinite(x) || !isfinite(y) || !isfinite(z)) return call_ends(0, ERROR_NONE);
  if (take_pending(EVENT_FORCE_ERROR)) return call_ends(-1, ERROR_COM);
  const double size = length(force), before = length(state->commanded);
  double share = take_pending(EVENT_SATURATE) ? 0.5 : 1;
  if (state->max_force >= 0 && size > state->max_force && is_chosen(MAX_FORCE, "scale")) share = state->max_force / size;
  for (int i = 0; i < 3; ++i) state->commanded[i] = share * force[i];
  device_advance();
  count_contact(before, length(state->commanded));
  return call_ends(share < 1 ? kSaturatedResult : 0, ERROR_NONE);
}

PUBLISHED int dhdSetForce(double x, double y, double z, signed char id) {
  if (!call_begins("dhdSetForce", id)) return -1;
  return command(x, y, z);
}

static bool are_finite(const double* values, int count) {
  for (int i = 0; i < count; ++i)
    if (!isfinite(values[i])) fault(FAULT_NOT_FINITE, "%s", "a torque or a force of the gripper");
  return true;
}

PUBLISHED int dhdSetForceAndTorque(double x, double y, double z, double a, double b, double c, signed char id) {
  if (!call_begins("dhdSetForceAndTorque", id)) return -1;
  are_finite((const double[]){a, b, c}, 3);
  return command(x, y, z);
}

PUBLISHED int dhdSetForceAndGripperForce(double x, double y, double z, double gripper, signed char id) {
  if (!call_begins("dhdSetForceAndGripperForce", id)) return -1;
  are_finite(&gripper, 1);
  return command(x, y, z);
}

PUBLISHED int dhdSetForceAndTorqueAndGripperForce(double x, double y, double z, double a, double b, double c, double gripper,
                                                  signed char id) {
  if (!call_begins("dhdSetForceAndTorqueAndGripperForce", id)) return -1;
  are_finite((const double[]){a, b, c, gripper}, 4);
  return command(x, y, z);
}

// Needs two readings.
PUBLISHED int dhdGetLinearVelocity(double* x, double* y, double* z, signed char id) {
  if (!call_begins("dhdGetLinearVelocity", id)) return -1;
  if (any_null("dhdGetLinearVelocity", x, y, z)) return call_ends(-1, ERROR_NULL);
  if (session()->readings < 2) return call_ends(-1, ERROR_TIMEOUT);
  *x = state->arm.velocity[0];
  *y = state->arm.velocity[1];
  *z = state->arm.velocity[2];
  return call_ends(0, ERROR_NONE);
}

PUBLISHED unsigned dhdGetButtonMask(signed char id) {
  if (!call_begins("dhdGetButtonMask", id)) return 0;
  const unsigned mask = state->pressed ? 1 : 0;
  call_ends(0, ERROR_NONE);
  return mask;
}

PUBLISHED int dhdGetButton(int index, signed char id) {
  if (!call_begins("dhdGetButton", id)) return -1;
  if (index < 0 || index > 15) {
    fault(FAULT_RANGE, "dhdGetButton: %d", index);
    return call_ends(-1, ERROR_INVALID);
  }
  return call_ends(index == 0 && state->pressed ? 1 : 0, ERROR_NONE);
}

static int resting(const char* function, double* x, double* y, double* z, signed char id) {
  if (!call_begins(function, id)) return -1;
  if (any_null(function, x, y, z)) return call_ends(-1, ERROR_NULL);
  *x = *y = *z = 0;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetOrientationRad(double* a, double* b, double* c, signed char id) {
  return resting("dhdGetOrientationRad", a, b, c, id);
}

PUBLISHED int dhdGetOrientationDeg(double* a, double* b, double* c, signed char id) {
  return resting("dhdGetOrientationDeg", a, b, c, id);
}

PUBLISHED int dhdGetOrientationFrame(double matrix[3][3], signed char id) {
  if (!call_begins("dhdGetOrientationFrame", id)) return -1;
  if (any_null("dhdGetOrientationFrame", (double*)matrix, (double*)matrix, (double*)matrix)) return call_ends(-1, ERROR_NULL);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) matrix[i][j] = i == j ? 1 : 0;
  return call_ends(0, ERROR_NONE);
}

static int gripper(const char* function, double* value, double is, signed char id) {
  if (!call_begins(function, id)) return -1;
  if (any_null(function, value, value, value)) return call_ends(-1, ERROR_NULL);
  *value = is;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetGripperGap(double* gap, signed char id) {
  return gripper("dhdGetGripperGap", gap, kGap, id);
}

PUBLISHED int dhdGetGripperAngleRad(double* angle, signed char id) {
  return gripper("dhdGetGripperAngleRad", angle, 0.2, id);
}

PUBLISHED int dhdGetGripperAngleDeg(double* angle, signed char id) {
  return gripper("dhdGetGripperAngleDeg", angle, 11.5, id);
}
