#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace cbc {

/// Calls work(0) in this thread, and work(1) to work(count - 1) in others at the same time; those
/// that the system cannot start are left out, so what is to be done must not depend on their
/// number. Waits for all. If one threw an exception, throws that of the lowest number.
inline void run_in_threads(std::size_t count, const std::function<void(std::size_t)>& work) {
  std::vector<std::exception_ptr> errors(count);
  const auto run = [&](std::size_t number) {
    try {
      work(number);
    } catch (...) {
      errors[number] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  threads.reserve(count);
  try {
    while (threads.size() + 1 < count) threads.emplace_back(run, threads.size() + 1);
  } catch (const std::exception&) {
    // There are no more threads, or there is no memory for them: those that exist do the work.
  }
  run(0);
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& error : errors) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace cbc
