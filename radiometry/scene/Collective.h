// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/Communicator.h"
#include "radiometry/scene/InputError.h"

#include <exception>
#include <stdexcept>

namespace radiometry
{

/// What an exception says on a rank that could have gone on.
inline constexpr char AnotherRankFailed[] = "another rank failed";

/// Runs a rank's own part of a collective step. Where it throws on one rank (an abort, a lack of
/// memory), it ends by an exception on all: the rank's own, or else Aborted, so that none waits for
/// another. `ranks` null: runs it. Collective.
template <class Part>
void Collectively(const Communicator* ranks, Part&& part)
{
  if (!ranks || ranks->Size() == 1)
  {
    part();
    return;
  }
  std::exception_ptr own;
  double failed[2] = { 0.0, 0.0 }; // aborted, otherwise
  try
  {
    part();
  }
  catch (const Aborted&)
  {
    own = std::current_exception();
    failed[0] = 1.0;
  }
  catch (...)
  {
    own = std::current_exception();
    failed[1] = 1.0;
  }
  ranks->Largest(failed, 2);
  if (own)
  {
    std::rethrow_exception(own);
  }
  if (failed[1] > 0.0)
  {
    throw std::runtime_error(AnotherRankFailed);
  }
  if (failed[0] > 0.0)
  {
    throw Aborted();
  }
}

} // namespace radiometry
