// Counts what happened in a run, so that the property test can tell that its cases mean something.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace cbc::oracle {

class Statistics {
 public:
  void count(const std::string& what) { ++counts_[what]; }

  void merge(const Statistics& other) {
    for (const auto& [what, times] : other.counts_) {
      counts_[what] += times;
    }
  }

  std::int64_t of(const std::string& what) const {
    const auto found = counts_.find(what);
    return found == counts_.end() ? 0 : found->second;
  }

  const std::map<std::string, std::int64_t>& all() const { return counts_; }

 private:
  std::map<std::string, std::int64_t> counts_;
};

}  // namespace cbc::oracle
