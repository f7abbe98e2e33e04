// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A session in a window: the loop of frames between the participant and the servo loop.

#include <optional>

#include "forceshade/experiments/session.h"
#include "forceshade/window/scene.h"
#include "forceshade/window/window.h"

namespace forceshade::window {

// What is on the other side of the window: the servo loop and what it renders. Every call comes from the thread of the window,
// and returns without waiting for a tick.
class Laboratory {
 public:
  virtual ~Laboratory() = default;

  // s since the first tick of the run.
  virtual double time() = 0;

  // Where the tip was at the latest tick, and the height of the surface that was felt there. separation and width are the
  // protocol's, and need not be given.
  virtual Scene scene() = 0;

  // What is to be felt from now on; called at the start, and whenever it has changed.
  virtual void render(const experiments::Scene& scene) = 0;

  // Where the mouse means the hand to be, in the frame of the scene, once a frame; nothing while it is outside the window.
  virtual void aim(const std::optional<Position>& mouse) { static_cast<void>(mouse); }

  // False: the servo loop has ended, or the experimenter stops the session.
  virtual bool goes_on() = 0;
};

enum class Ending {
  over,     // the participant has seen the last screen and pressed enter
  closed,   // the window was closed
  stopped,  // by the laboratory
};

// Shows the session until one of these. Every press that came before has then been given to the session, so it is in its log;
// what the session renders is nothing after its end, else what it was. To stop the servo loop, which sets the force to zero,
// and to close the session is the caller's. A press that comes within the same frame as one that changed the screen is left
// out: it was meant for a screen that the participant had not seen. Throws what the session's log and the laboratory throw.
Ending run(Window& window, experiments::Session& session, Laboratory& laboratory);

}  // namespace forceshade::window
