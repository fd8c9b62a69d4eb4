#pragma once

namespace lightwell::serve {

/// Answers the lines of a host until it says quit or closes its end of the pipe.
/// @param requests, answers  file descriptors
void answer(int requests, int answers);

} // namespace lightwell::serve
