#pragma once
#include <chrono>

namespace cupola {

/// When this process was started, before its libraries were loaded: to a hundredth of a second, from the kernel's
/// account (/proc/self/stat); now where there is none.
std::chrono::steady_clock::time_point process_start();

}  // namespace cupola
