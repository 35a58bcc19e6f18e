// For ./dev mutants: writes a line for each test into the file in CBC_MUTANTS_RECORD: its name,
// whether it passed, its seconds of processor time, and, in hexadecimal digits, a bit for each
// mutant that it has reached (see mutant.h). Without that variable this does nothing.

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <span>
#include <sys/resource.h>

#include <gtest/gtest.h>

#include "mutants/mutant.h"

namespace {

double seconds_of(int who) {
  rusage usage{};
  getrusage(who, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) / 1e6;
}

double processor_seconds() { return seconds_of(RUSAGE_SELF) + seconds_of(RUSAGE_CHILDREN); }

class Recorder final : public testing::EmptyTestEventListener {
 public:
  explicit Recorder(const char* record)
      : record_(record), reached_(cbc::mutant::map_reached()), before_(processor_seconds()) {}

  // What was reached since the test before, by what the tests of a suite share, counts for the
  // first.
  void OnTestEnd(const testing::TestInfo& test) override {
    const double now = processor_seconds();
    record_ << test.test_suite_name() << '.' << test.name() << '\t'
            << (test.result()->Passed() || test.result()->Skipped() ? "passed" : "failed") << '\t'
            << now - before_ << '\t';
    for (std::size_t i = 0; i < reached_.size(); i += 4) {
      unsigned digit = 0;
      for (std::size_t bit = 0; bit < 4 && i + bit < reached_.size(); ++bit) {
        digit |= unsigned{reached_[i + bit]} << bit;
      }
      record_ << "0123456789abcdef"[digit];
    }
    record_ << std::endl;
    std::fill(reached_.begin(), reached_.end(), static_cast<unsigned char>(0));
    before_ = processor_seconds();
  }

 private:
  std::ofstream record_;
  std::span<unsigned char> reached_;
  double before_;
};

const bool is_recording = [] {
  const char* const record = std::getenv("CBC_MUTANTS_RECORD");
  if (record == nullptr) return false;
  testing::UnitTest::GetInstance()->listeners().Append(new Recorder(record));
  return true;
}();

}  // namespace
