// SPDX-License-Identifier: BSD-3-Clause
// The functions that a client calls once: brakes, forces, gravity, limits, the functions of the expert mode; and the status.

#include <math.h>
#include <string.h>
#include <unistd.h>

#include "stand_in.h"

PUBLISHED int dhdGetStatus(int* status, signed char id) {
  if (!call_begins("dhdGetStatus", id)) return -1;
  if (!status) {
    fault(FAULT_NULL, "%s", "dhdGetStatus");
    return call_ends(-1, ERROR_NULL);
  }
  const bool is_idle = !state->reset && !state->forces_on && !state->brakes_on;
  const int all[kStatusLength] = {state->powered,
                                  state->plugged,
                                  1,
                                  state->reset,
                                  is_idle,
                                  state->forces_on && !state->reset,
                                  state->brakes_on,
                                  0,
                                  0,
                                  state->has_error,
                                  state->gravity,
                                  state->time_guard_us > 0,
                                  0,
                                  0,
                                  state->forces_on ? 0 : state->cause,
                                  0,
                                  0};
  const bool is_short = is_chosen(STATUS_LENGTH, "16");
  memcpy(status, all, sizeof(int) * (is_short ? kStatusLength - 1 : kStatusLength));
  return call_ends(0, ERROR_NONE);
}

static bool is_switch(const char* function, int value) {
  if (value == 0 || value == 1) return true;
  fault(FAULT_RANGE, "%s: %d", function, value);
  return false;
}

PUBLISHED int dhdEnableForce(unsigned char on, signed char id) {
  if (!call_begins("dhdEnableForce", id)) return -1;
  if (!is_switch("dhdEnableForce", on)) return call_ends(-1, ERROR_INVALID);
  if (on && (state->reset && is_chosen(ENABLE_UNCALIBRATED, "error"))) return call_ends(-1, ERROR_NOT_READY);
  if (on && !state->powered) return call_ends(-1, ERROR_NOT_READY);
  if (!on && length(state->arm.force) > small()) fault(FAULT_FORCE_AT_END, "%.3f N", length(state->arm.force));
  state->forces_on = on;
  state->brakes_on = !on;
  state->cause = CAUSE_NONE;
  state->cut_ns = 0;
  session()->enabled_ns = on ? now_ns() : 0;
  note(on ? "enabled" : "disabled");
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdEnableGripperForce(unsigned char on, signed char id) {
  if (!call_begins("dhdEnableGripperForce", id)) return -1;
  return is_switch("dhdEnableGripperForce", on) ? call_ends(0, ERROR_NONE) : call_ends(-1, ERROR_INVALID);
}

PUBLISHED int dhdSetBrakes(int on, signed char id) {
  if (!call_begins("dhdSetBrakes", id)) return -1;
  if (!is_switch("dhdSetBrakes", on)) return call_ends(-1, ERROR_INVALID);
  state->brakes_on = on;
  if (on) state->forces_on = false;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdSetGravityCompensation(int on, signed char id) {
  if (!call_begins("dhdSetGravityCompensation", id)) return -1;
  if (!is_switch("dhdSetGravityCompensation", on)) return call_ends(-1, ERROR_INVALID);
  state->gravity = on;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdReset(signed char id) {
  if (!call_begins("dhdReset", id)) return -1;
  state->reset = true;
  device_cut(CAUSE_NONE);
  return call_ends(0, ERROR_NONE);
}

// Puts the device into its RESET mode; the hand in which it is calibrates it after 0.2 s.
PUBLISHED int dhdWaitForReset(int milliseconds, signed char id) {
  if (!call_begins("dhdWaitForReset", id)) return -1;
  if (milliseconds < 0) {
    fault(FAULT_RANGE, "dhdWaitForReset: %d", milliseconds);
    return call_ends(-1, ERROR_INVALID);
  }
  state->reset = true;
  const bool in_time = milliseconds == 0 || milliseconds > 200;
  unlock();
  usleep(in_time ? 200000 : (useconds_t)milliseconds * 1000);
  lock();
  state->reset = !in_time;
  return call_ends(in_time ? 0 : -1, ERROR_TIMEOUT);
}

// The end of a call that wrote a number to this place.
static int given(const char* function, const void* place) {
  if (place) return call_ends(0, ERROR_NONE);
  fault(FAULT_NULL, "%s", function);
  return call_ends(-1, ERROR_NULL);
}

// Sets a limit; a negative number removes it.
static int set_limit(const char* function, double* limit, double most, signed char id) {
  if (!call_begins(function, id)) return -1;
  if (!isfinite(most)) {
    fault(FAULT_NOT_FINITE, "%s", function);
    return call_ends(-1, ERROR_INVALID);
  }
  *limit = most < 0 ? -1 : most;
  return call_ends(0, ERROR_NONE);
}

static double limit(const char* function, const double* its, signed char id) {
  if (!call_begins(function, id)) return -1;
  const double most = *its;
  call_ends(0, ERROR_NONE);
  return most;
}

PUBLISHED int dhdSetMaxForce(double most, signed char id) {
  return set_limit("dhdSetMaxForce", &state->max_force, most, id);
}

PUBLISHED double dhdGetMaxForce(signed char id) {
  return limit("dhdGetMaxForce", &state->max_force, id);
}

PUBLISHED int dhdSetMaxTorque(double most, signed char id) {
  return set_limit("dhdSetMaxTorque", &state->max_torque, most, id);
}

PUBLISHED double dhdGetMaxTorque(signed char id) {
  return limit("dhdGetMaxTorque", &state->max_torque, id);
}

PUBLISHED int dhdSetMaxGripperForce(double most, signed char id) {
  return set_limit("dhdSetMaxGripperForce", &state->max_gripper_force, most, id);
}

PUBLISHED double dhdGetMaxGripperForce(signed char id) {
  return limit("dhdGetMaxGripperForce", &state->max_gripper_force, id);
}

PUBLISHED int dhdSetEffectorMass(double mass, signed char id) {
  if (!call_begins("dhdSetEffectorMass", id)) return -1;
  if (mass >= 0 && mass < 10) {
    state->effector_mass = mass;
    return call_ends(0, ERROR_NONE);
  }
  fault(FAULT_RANGE, "dhdSetEffectorMass: %g kg", mass);
  return call_ends(-1, ERROR_INVALID);
}

PUBLISHED int dhdGetEffectorMass(double* mass, signed char id) {
  if (!call_begins("dhdGetEffectorMass", id)) return -1;
  if (mass) *mass = state->effector_mass;
  return given("dhdGetEffectorMass", mass);
}

PUBLISHED int dhdSetStandardGravity(double gravity, signed char id) {
  if (!call_begins("dhdSetStandardGravity", id)) return -1;
  if (isfinite(gravity)) return call_ends(0, ERROR_NONE);
  fault(FAULT_NOT_FINITE, "%s", "dhdSetStandardGravity");
  return call_ends(-1, ERROR_INVALID);
}

// The button of a gripper that is closed; here the gripper never is.
PUBLISHED int dhdEmulateButton(unsigned char on, signed char id) {
  if (!call_begins("dhdEmulateButton", id)) return -1;
  if (!is_switch("dhdEmulateButton", on)) return call_ends(-1, ERROR_INVALID);
  return has_gripper() ? call_ends(0, ERROR_NONE) : call_ends(-1, ERROR_NOT_AVAILABLE);
}

PUBLISHED int dhdSetOutput(unsigned output, signed char id) {
  if (!call_begins("dhdSetOutput", id)) return -1;
  (void)output;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdSetVibration(double frequency, double amplitude, int type, signed char id) {
  if (!call_begins("dhdSetVibration", id)) return -1;
  (void)type;
  if (isfinite(frequency) && isfinite(amplitude)) return call_ends(0, ERROR_NONE);
  fault(FAULT_NOT_FINITE, "%s", "dhdSetVibration");
  return call_ends(-1, ERROR_INVALID);
}

static int config_velocity(const char* function, int milliseconds, int mode, signed char id) {
  if (!call_begins(function, id)) return -1;
  if (milliseconds >= 0 && mode == 0) return call_ends(0, ERROR_NONE);
  fault(FAULT_RANGE, "%s: %d ms, mode %d", function, milliseconds, mode);
  return call_ends(-1, ERROR_INVALID);
}

PUBLISHED int dhdConfigLinearVelocity(int milliseconds, int mode, signed char id) {
  return config_velocity("dhdConfigLinearVelocity", milliseconds, mode, id);
}

PUBLISHED int dhdConfigAngularVelocity(int milliseconds, int mode, signed char id) {
  return config_velocity("dhdConfigAngularVelocity", milliseconds, mode, id);
}

PUBLISHED int dhdConfigGripperVelocity(int milliseconds, int mode, signed char id) {
  return config_velocity("dhdConfigGripperVelocity", milliseconds, mode, id);
}

PUBLISHED int dhdGetComMode(signed char id) {
  if (!call_begins("dhdGetComMode", id)) return -1;
  return call_ends(1, ERROR_NONE);
}

// kHz, by the forces of the session.
PUBLISHED double dhdGetComFreq(signed char id) {
  if (!call_begins("dhdGetComFreq", id)) return 0;
  const double seconds = (double)(now_ns() - session()->opened_ns) / 1e9;
  const double rate = seconds > 0 ? (double)session()->forces / seconds / 1000 : 0;
  call_ends(0, ERROR_NONE);
  return rate;
}

PUBLISHED int dhdSetWatchdog(unsigned char units, signed char id) {
  if (!expert_call_begins("dhdSetWatchdog", id)) return -1;
  if (is_chosen(WATCHDOG_WORKS, "no")) return call_ends(-1, ERROR_NOT_IMPLEMENTED);
  state->watchdog = units;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdSetTimeGuard(int micros, signed char id) {
  if (!expert_call_begins("dhdSetTimeGuard", id)) return -1;
  if (micros < -1) {
    fault(FAULT_RANGE, "dhdSetTimeGuard: %d", micros);
    return call_ends(-1, ERROR_INVALID);
  }
  state->time_guard_us = micros < 0 ? (int32_t)number_chosen(TIME_GUARD) : micros;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetWatchdog(unsigned char* units, signed char id) {
  if (!expert_call_begins("dhdGetWatchdog", id)) return -1;
  if (units) *units = (unsigned char)state->watchdog;
  return given("dhdGetWatchdog", units);
}

PUBLISHED int dhdSetVelocityThreshold(unsigned threshold, signed char id) {
  if (!expert_call_begins("dhdSetVelocityThreshold", id)) return -1;
  state->velocity_threshold = threshold;
  return call_ends(0, ERROR_NONE);
}

PUBLISHED int dhdGetVelocityThreshold(unsigned* threshold, signed char id) {
  if (!expert_call_begins("dhdGetVelocityThreshold", id)) return -1;
  if (threshold) *threshold = state->velocity_threshold;
  return given("dhdGetVelocityThreshold", threshold);
}

PUBLISHED int dhdSetComMode(int mode, signed char id) {
  if (!expert_call_begins("dhdSetComMode", id)) return -1;
  if (mode >= 0 && mode <= 4 && mode != 2) return call_ends(0, ERROR_NONE);
  fault(FAULT_RANGE, "dhdSetComMode: %d", mode);
  return call_ends(-1, ERROR_INVALID);
}
