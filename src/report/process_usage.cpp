#include "report/process_usage.h"

#include <sys/resource.h>

namespace cbc {
namespace {

Microseconds to_microseconds(const timeval& time) { return time.tv_sec * second + time.tv_usec; }

}  // namespace

ProcessUsage process_usage() {
  rusage usage{};
  if (::getrusage(RUSAGE_SELF, &usage) != 0) return {};
  constexpr std::uint64_t kibibyte = 1024;  // the unit of Linux
  return {static_cast<std::uint64_t>(usage.ru_maxrss) * kibibyte,
          to_microseconds(usage.ru_utime) + to_microseconds(usage.ru_stime)};
}

}  // namespace cbc
