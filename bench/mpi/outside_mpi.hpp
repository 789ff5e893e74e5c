// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::bench {

/// Processor time of this process since its start, in milliseconds, without what passed in collectives of MPI, where
/// ranks that wait for others keep a processor busy.
double outside_mpi_ms();

}  // namespace boxstream::bench
