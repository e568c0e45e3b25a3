// SPDX-License-Identifier: BSD-3-Clause
// Private to io/: OpenEXR's tasks on oneTBB.
#pragma once

namespace radiometry::io
{

/// The number of threads to tell OpenEXR for `wanted` (0: all). For more than one, OpenEXR's
/// global pool is first put on oneTBB, once a process, unless someone else has given it threads
/// already. 0 means that the caller's thread does the work.
int ExrThreads(int wanted);

} // namespace radiometry::io
