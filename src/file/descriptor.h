#pragma once

#include <unistd.h>

namespace cbc {

/// An open file, which is closed when it is no longer needed; or none.
class Descriptor {
 public:
  Descriptor() = default;
  /// Takes over the file; a negative number is none.
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }

  void set(int number) {
    close();
    number_ = number;
  }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_ = -1;
};

}  // namespace cbc
