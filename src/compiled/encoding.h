#pragma once

#include <cstdint>
#include <string_view>

#include "compiled/compiled_file.h"

/// The bytes of compiled catalogs: see catalog.fbs, which flatc turns into code.
namespace cbc {

/// The newest format, which is the one that is written.
inline constexpr std::uint32_t newest_format = 1;

/// A file whose arrays lie in `bytes`, which begin at a multiple of 16. They are readable and
/// aligned, and the digest fits, but what is in them is not verified yet.
[[nodiscard]] CompiledFileResult decode(std::string_view bytes);

}  // namespace cbc
