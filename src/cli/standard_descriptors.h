#pragma once

namespace cbc::cli {

/// Where the program was started with a standard stream closed, keeps the next file that it opens
/// from taking its place: reading from it or writing to it fails, as it should, and messages go
/// nowhere.
void hold_standard_descriptors();

}  // namespace cbc::cli
