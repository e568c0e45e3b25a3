// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/InputError.h"

namespace radiometry
{

/// How a computation talks to whoever started it. The core never prints.
///
/// Called from the thread that started the computation only, at least every 0.2 s, between rounds
/// of parallel work.
class Monitor
{
public:
  virtual ~Monitor() = default;
  /// `fraction` of the whole run in [0, 1] and the stage's name. Returns false to ask for a stop.
  virtual bool Progress(double fraction, const char* stage) = 0;
  /// The whole run is expected to take that many seconds; said once, before they are spent.
  virtual void Predicted(double /*seconds*/) {}
};

/// Report and stop when asked to: throws Aborted. A null monitor is silent and never stops.
inline void Report(Monitor* monitor, double fraction, const char* stage)
{
  if (monitor && !monitor->Progress(fraction, stage))
  {
    throw Aborted();
  }
}

} // namespace radiometry
