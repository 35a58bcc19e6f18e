#pragma once

#include "verify/report/verify_report.h"
#include "verify/verify.h"

// The scripts that `cbc verify` has found are run as `cbc solve` does, before they are shown, and
// written to the folder of --scripts if there is one.

namespace cbc::cli {

/// Of all counterexamples and witnesses. Returns the exit status, and prints what is wrong.
[[nodiscard]] int replay_answers(const VerifyOptions& options, VerifyResult& result);

/// The same of all outcomes.
[[nodiscard]] int replay_outcomes(const VerifyOptions& options, VerifyResult& result);

/// The same of the differences of two catalogs.
[[nodiscard]] int replay_differences(const VerifyOptions& options, VerifyResult& result);

}  // namespace cbc::cli
