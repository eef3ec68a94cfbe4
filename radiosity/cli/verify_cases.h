#pragma once

#include "radiosity/cli/verify_case.h"

namespace hemicube::radiosity::cli {

/// What `hemicube verify` computes.
std::vector<VerifyCase> verify_cases();

/// What `--all` adds: near, thin, tiny, far, grazing, coincident, nearly white. Their bounds are
/// those of tests/hard_cases/README.md.
std::vector<VerifyCase> verify_hard_cases();

} // namespace hemicube::radiosity::cli
