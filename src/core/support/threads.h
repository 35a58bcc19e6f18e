#pragma once

#include <cstddef>
#include <functional>

namespace cbc {

/// Calls work(0) in this thread, and work(1) to work(count - 1) in others at the same time; those
/// that the system cannot start are left out, so what is to be done must not depend on their
/// number. Waits for all. If one threw an exception, throws that of the lowest number.
void run_in_threads(std::size_t count, const std::function<void(std::size_t)>& work);

}  // namespace cbc
