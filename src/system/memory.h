// How the process keeps memory.
#pragma once

namespace holomorph {

/// Lets the allocator keep freed memory for later, up to a limit for each of its arenas, instead of
/// returning it to the system. Each frame of a drag frees what the last one allocated. Otherwise,
/// the system would clear the same pages again in each frame, which takes up to 14 % of a frame.
/// Call it once, before other threads start. Does nothing if the C library is not glibc.
void keep_freed_memory();

/// Returns the memory that is free now to the system, for example after a file has been read. Does
/// nothing if the C library is not glibc.
void return_freed_memory();

/// The number of memory pages that the system has prepared for this process so far.
long page_faults();

}  // namespace holomorph
