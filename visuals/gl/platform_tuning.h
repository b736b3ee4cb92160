#pragma once

namespace octant::visuals::gl {

/// Keeps freed memory in the process. Mesa's software renderer frees its working memory after each frame; glibc would
/// hand the pages back to the kernel and take page faults for them in the next one (1.8 times the frame time). Must be
/// the first call in main(): memory allocated earlier is not affected. Does nothing on other C libraries.
void tune_allocator();

/// Gives each raster thread of Mesa's software renderer a processor of its own, because the kernel likes to leave two
/// of them on one. Does nothing when there are more processors than threads. To be called after a first picture
/// (Renderer::warm_up): the threads are known by the names that they give themselves once they run. Returns how many
/// threads were placed.
int spread_raster_threads();

} // namespace octant::visuals::gl
