// SPDX-License-Identifier: BSD-3-Clause
// The device: its arm, its watchdog, and what happens to it.

#include <math.h>
#include <string.h>
#include <time.h>

#include "stand_in.h"

static bool pending[kEvents];

double length(const double force[3]) {
  return sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
}

double small(void) {
  return kSmall / 1000.0;
}

void device_opened(void) {
  arm_begin(&state->arm);
  memset(pending, 0, sizeof pending);
  state->time_ns = now_ns();
  state->forces_on = is_chosen(FORCES, "on");
  state->brakes_on = is_chosen(BRAKES, "on");
  state->gravity = state->powered = state->plugged = true;
  state->reset = is_chosen(CALIBRATED, "no");
  state->pressed = is_chosen(PRESSED, "yes");
  state->was_in_contact = state->was_settling = state->has_error = false;
  state->cause = CAUSE_NONE;
  state->cut_ns = state->unplugged_ns = state->last_read_ns = 0;
  state->watchdog = (int32_t)number_chosen(WATCHDOG);
  state->time_guard_us = (int32_t)number_chosen(TIME_GUARD);
  state->max_force = state->max_torque = state->max_gripper_force = -1;
  state->effector_mass = 0.1;
  state->velocity_threshold = 255;
  memset(state->base_angle, 0, sizeof state->base_angle);
  memset(state->commanded, 0, sizeof state->commanded);
  memset(state->last_read, 0, sizeof state->last_read);
}

// Zero where the device gives none.
static void apply(void) {
  const bool acts = state->forces_on && state->powered && state->plugged && !state->brakes_on && !state->reset;
  for (int i = 0; i < 3; ++i) state->arm.force[i] = acts ? state->commanded[i] : 0;
}

void device_cut(int cause) {
  if (state->forces_on) state->cut_ns = now_ns();
  state->forces_on = false;
  state->brakes_on = true;
  state->cause = cause;
  apply();
}

void device_advance(void) {
  const int64_t now = now_ns();
  const int64_t limit = state->watchdog * INT64_C(125000);
  const int64_t last = session()->last_force_ns > session()->enabled_ns ? session()->last_force_ns : session()->enabled_ns;
  apply();
  double seconds = (double)(now - state->time_ns) / 1e9;
  if (limit > 0 && state->forces_on && last > 0 && now - last > limit) {
    const double held = fmax(0, (double)(last + limit - state->time_ns) / 1e9);
    if (is_chosen(CLOCK, "real")) arm_advance(&state->arm, fmin(held, 1));
    seconds -= held;
    device_cut(CAUSE_WATCHDOG);
    note("watchdog");
  }
  // A hand is not simulated for longer than it can be felt.
  if (is_chosen(CLOCK, "real") && seconds > 0) arm_advance(&state->arm, fmin(seconds, 1));
  state->time_ns = now;
}

void device_happen(enum event event) {
  note(kEventTable[event].name);
  switch (event) {
    case EVENT_UNPLUG:
      state->plugged = false;
      state->unplugged_ns = now_ns();
      break;
    case EVENT_BUTTON: device_cut(CAUSE_BUTTON); break;
    case EVENT_OVERSPEED: device_cut(CAUSE_VELOCITY); break;
    case EVENT_USB: device_cut(CAUSE_USB); break;
    case EVENT_DEADMAN: device_cut(CAUSE_DEADMAN); break;
    case EVENT_UNCALIBRATED: state->reset = true; break;
    case EVENT_CALIBRATED: state->reset = false; break;
    case EVENT_PRESS: state->pressed = !state->pressed; break;
    case EVENT_ERROR: state->has_error = true; break;
    case EVENT_POWER_OFF:
      state->powered = false;
      device_cut(CAUSE_NONE);
      break;
    case EVENT_LATE:
    case EVENT_NAN:
    case EVENT_GARBAGE:
    case EVENT_WRONG_UNIT:
    case EVENT_JUMP:
    case EVENT_SATURATE:
    case EVENT_TIME_GUARD:
    case EVENT_READ_ERROR:
    case EVENT_FORCE_ERROR: pending[event] = true;
  }
  apply();
}

bool take_pending(enum event event) {
  const bool was = pending[event];
  pending[event] = false;
  return was;
}
