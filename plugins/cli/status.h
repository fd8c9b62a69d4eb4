#pragma once

namespace lightwell {

/// Exit status of the program.
enum class Status {
    done = 0,
    no = 1,        ///< the answer is "no", or the work was interrupted
    usage = 2,     ///< the command line is not understood
    bad_input = 3, ///< a file or value cannot be used
    our_fault = 4
};

} // namespace lightwell
